// Tests that the sigmas of the recommended filters match their errors, where these filters differ from the
// papers. The tests fly the campaigns of bench/monte_carlo/honesty. These campaigns judge with 200 runs; here
// they have as many runs as the time of CTest permits.
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
TEST(Honesty, OfTheWind) { expect_bars_met("bench/monte_carlo/honesty/wind.toml", 23, 24); }

}  // namespace
}  // namespace canhil::papers
