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
TEST(Honesty, OfTheWind) { expect_bars_met("bench/monte_carlo/honesty/wind.toml", 25, 24); }
// With the errors of ordinary sensors, told truthfully and wrongly. The full campaigns have 200 runs.
TEST(Honesty, OfTheTransferAlignmentWithOrdinarySensors) {
  expect_bars_met("bench/monte_carlo/honesty/ordinary_sensors.toml", 38, 12);
}
TEST(Honesty, OfTheWindWithOrdinarySensors) {
  expect_bars_met("bench/monte_carlo/honesty/ordinary_glide.toml", 15, 4);
}
TEST(Honesty, OfTheLosRateWithAnOrdinarySeeker) {
  expect_bars_met("bench/monte_carlo/honesty/ordinary_seeker.toml", 6, 30);
}

}  // namespace
}  // namespace canhil::papers
