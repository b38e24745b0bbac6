// The sigmas of the filters that we recommend beyond the papers match their errors: runs the campaigns of
// bench/monte_carlo/honesty. They are judged with 200 runs there, and with as many as CTest has time for
// here.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheTransferAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/transfer_alignment.toml", 71, 100);
}
TEST(Honesty, OfTheInflightAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_alignment.toml", 117, 40);
}
TEST(Honesty, OfTheLosRate) { expect_bars_met("bench/monte_carlo/honesty/los_rate.toml", 44, 60); }
TEST(Honesty, OfTheWind) { expect_bars_met("bench/monte_carlo/honesty/wind.toml", 21, 24); }

}  // namespace
}  // namespace canhil::papers
