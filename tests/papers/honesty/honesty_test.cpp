// Tests that the errors of the recommended filters match the sigmas that these filters report. (The papers do
// not have these filters.) The tests fly the campaigns of bench/monte_carlo/honesty. A full campaign has 200
// runs; here it has only as many as the time limit of CTest permits. Limits of shares and of means scale with
// the number of runs: of fewer than 100 runs, a share of 1 % permits none to err and be sure, and a mean of
// few runs may be further from its expectation. So these runs find sigmas that are wrong by a third; a full
// campaign finds 15 %. The mean share of answers that say degraded, and the mean error of the wind, are not
// judged here: one run of many dominates them.
#include "tests/papers/bars.hpp"

namespace canhil::papers {
namespace {

TEST(Honesty, OfTheTransferAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/transfer_alignment.toml", 71, 60);
}
TEST(Honesty, OfTheTransferAlignmentWithOrdinarySensors) {
  expect_bars_met("bench/monte_carlo/honesty/ordinary_sensors.toml", 42, 16,
                  {"share of answers that say degraded"});
}
TEST(Honesty, OfTheInflightAlignment) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_alignment.toml", 91, 12);
}
TEST(Honesty, OfTheInflightAlignmentInOtherRegimes) {
  expect_bars_met("bench/monte_carlo/honesty/inflight_regimes.toml", 46, 8,
                  {"share of answers that say degraded from 60 s on"});
}
TEST(Honesty, OfTheLosRate) { expect_bars_met("bench/monte_carlo/honesty/los_rate.toml", 44, 40); }
TEST(Honesty, OfTheLosRateWithAnOrdinarySeeker) {
  expect_bars_met("bench/monte_carlo/honesty/ordinary_seeker.toml", 11, 40);
}
TEST(Honesty, OfTheWind) {
  expect_bars_met("bench/monte_carlo/honesty/wind.toml", 55, 6,
                  {"share of answers that say degraded", "error, 20 % wrong", "error, 40 % wrong"});
}

}  // namespace
}  // namespace canhil::papers
