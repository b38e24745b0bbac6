// The paper's acceptance limits ('bars') over the bus: the codec with quantised frames, 40 runs. bars.toml
// derives the limits.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(TransferAlignmentPaperOverTheBus, MeetsTheBarsWith40Runs) {
  expect_bars_met("tests/papers/transfer_alignment_bus/bars.toml", 9);
}

}  // namespace
}  // namespace canhil::papers
