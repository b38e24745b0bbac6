// The load of the bus by the lengths of all frames.
#include "bench/checks/bus_load.hpp"

#include <gtest/gtest.h>

namespace canhil::checks {
namespace {

TEST(BusLoad, IsThatOfTheBusiestWholeSecond) {
  Observations seen;
  seen.length_by_second = {{.nominal = 100'000}, {.nominal = 300'000}, {.nominal = 900'000}};
  const BusLoad load = bus_load(seen, {.nominal = 1'000'000});
  EXPECT_DOUBLE_EQ(load.busiest, 0.3) << "the run ended within the last second";
  EXPECT_DOUBLE_EQ(load.mean, 0.2);
  scenario::BusLoad rule{.bitrate = 1'000'000, .below = 0.31};
  EXPECT_EQ(judge(rule, seen).outcome, Outcome::pass);
  rule.below = 0.3;
  EXPECT_EQ(judge(rule, seen).outcome, Outcome::fail);
  rule = {.bitrate = 500'000, .below = 0.31};
  EXPECT_EQ(judge(rule, seen).outcome, Outcome::fail);
}

TEST(BusLoad, IsJudgedOnTheWireOfTheRunToo) {
  Observations seen;
  seen.length_by_second = {{.nominal = 300'000}};
  seen.bit_rates = {.nominal = 400'000};
  const scenario::BusLoad rule{.bitrate = 1'000'000, .below = 0.5};
  const Finding full = judge(rule, seen);
  EXPECT_EQ(full.outcome, Outcome::fail);
  EXPECT_EQ(full.measured,
            "30.0 % in the busiest second, 30.0 % in the mean; at the 400 kbit/s of this run's bus 75.0 % in "
            "the busiest second, 75.0 % in the mean");
  seen.bit_rates = {.nominal = 1'000'000};
  EXPECT_EQ(judge(rule, seen).outcome, Outcome::pass);
}

TEST(BusLoad, OfNothingIsNotAPass) {
  EXPECT_EQ(judge(scenario::BusLoad{.bitrate = 1'000'000, .below = 0.5}, {}).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
