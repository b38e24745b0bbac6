// Tests the acceptance limits ('bars') for the paper, with 40 runs over the bus, so that the values are
// quantised. bars.toml explains how the limits are derived.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(TransferAlignmentPaperOverTheBus, MeetsTheBarsWith40Runs) {
  expect_bars_met("tests/papers/transfer_alignment_bus/bars.toml", 9);
}

}  // namespace
}  // namespace canhil::papers
