// The paper's bars over the bus: the codec with frames quantised, 40 runs. bars.toml says how the bars
// follow.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(TransferAlignmentPaperOverTheBus, MeetsTheBarsWith40Runs) {
  expect_bars_met("tests/papers/transfer_alignment_bus/bars.toml", 9);
}

}  // namespace
}  // namespace canhil::papers
