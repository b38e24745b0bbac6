// The campaign of the LOS rate's honesty, with as many runs as CTest has time for.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheLosRate) { expect_bars_met("bench/monte_carlo/honesty/los_rate.toml", 40, 60); }

}  // namespace
}  // namespace canhil::papers
