// Tests that the errors of the recommended filters match the sigmas that these filters report. (The papers do
// not have these filters.) The tests fly the campaigns of bench/monte_carlo/honesty. A full campaign has 200
// runs; here it has only as many as the time limit of CTest permits.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheTransferAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/transfer_alignment.toml", 71, 100);
}
TEST(Honesty, OfTheInflightAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_alignment.toml", 119, 40);
}
TEST(Honesty, OfTheInflightAlignmentInOtherRegimes) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_regimes.toml", 50, 16);
}
TEST(Honesty, OfTheLosRate) { expect_bars_met("bench/monte_carlo/honesty/los_rate.toml", 44, 60); }
TEST(Honesty, OfTheWind) { expect_bars_met("bench/monte_carlo/honesty/wind.toml", 23, 24); }

}  // namespace
}  // namespace canhil::papers
