// The bus load, computed from the lengths of all frames.
#include "bench/checks/bus_load.hpp"

#include <gtest/gtest.h>

#include "bench/checks/kinds/bus_load.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::checks {
namespace {

TEST(BusLoad, IsThatOfTheBusiestWholeSecond) {
  Observations seen;
  seen.length_by_second = {{.nominal = 100'000}, {.nominal = 300'000}, {.nominal = 900'000}};
  const Load load = bus_load(seen, {.nominal = 1'000'000});
  EXPECT_DOUBLE_EQ(load.busiest, 0.3) << "the run ended within the last second";
  EXPECT_DOUBLE_EQ(load.mean, 0.2);
  BusLoad rule{.bitrate = 1'000'000, .below = 0.31};
  EXPECT_EQ(found(rule, seen).outcome, Outcome::pass);
  rule.below = 0.3;
  EXPECT_EQ(found(rule, seen).outcome, Outcome::fail);
  rule = {.bitrate = 500'000, .below = 0.31};
  EXPECT_EQ(found(rule, seen).outcome, Outcome::fail);
}

TEST(BusLoad, IsJudgedOnTheWireOfTheRunToo) {
  Observations seen;
  seen.length_by_second = {{.nominal = 300'000}};
  seen.bit_rates = {.nominal = 400'000};
  const BusLoad rule{.bitrate = 1'000'000, .below = 0.5};
  const Finding full = found(rule, seen);
  EXPECT_EQ(full.outcome, Outcome::fail);
  EXPECT_EQ(full.measured,
            "30.0 % in the busiest second, 30.0 % in the mean; at the 400 kbit/s of this run's bus 75.0 % in "
            "the busiest second, 75.0 % in the mean");
  seen.bit_rates = {.nominal = 1'000'000};
  EXPECT_EQ(found(rule, seen).outcome, Outcome::pass);
}

// 60 000 bits in the data phase take 30 ms at 2 Mbit/s and 12 ms at 5 Mbit/s.
TEST(BusLoad, IsJudgedOnTheWireOfTheRunTooWhereItsDataRateAloneDiffers) {
  Observations seen;
  seen.length_by_second = {{.nominal = 5'000, .data = 60'000}};
  seen.bit_rates = {.nominal = 500'000, .data = 2'000'000};
  BusLoad rule{.bitrate = 500'000, .data_bitrate = 5'000'000, .below = 0.03};
  const Finding full = found(rule, seen);
  EXPECT_EQ(full.outcome, Outcome::fail);
  EXPECT_EQ(
      full.measured,
      "2.2 % in the busiest second, 2.2 % in the mean; at the 500 and 2000 kbit/s of this run's bus 4.0 % "
      "in the busiest second, 4.0 % in the mean");
  EXPECT_EQ(full.expected.text, "< 3 % of 500 and 5000 kbit/s, and of this run's bus");
  rule.data_bitrate = 2'000'000;
  rule.below = 0.05;
  EXPECT_EQ(found(rule, seen).expected.text, "< 5 % of 500 and 2000 kbit/s");
  // Classic frames have no data phase. Without a data rate, FD frames use the nominal rate throughout.
  seen.length_by_second = {{.nominal = 5'000}};
  rule.data_bitrate = 0;
  EXPECT_EQ(found(rule, seen).expected.text, "< 5 % of 500 kbit/s");
  seen.length_by_second = {{.nominal = 5'000, .data = 60'000}};
  seen.bit_rates = {.nominal = 500'000, .data = 0};
  rule.data_bitrate = 500'000;
  EXPECT_EQ(found(rule, seen).expected.text, "< 5 % of 500 and 500 kbit/s");
}

TEST(BusLoad, OfNothingIsNotAPass) {
  EXPECT_EQ(found(BusLoad{.bitrate = 1'000'000, .below = 0.5}, {}).outcome, Outcome::fail);
}

}  // namespace
}  // namespace canhil::checks
