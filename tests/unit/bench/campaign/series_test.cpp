#include "bench/campaign/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/checks/errors.hpp"
#include "bench/run/contract.hpp"
#include "bench/run/flight.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

TEST(Series, BytesAreDoublesLittleEndian) {
  Sample sample;
  sample.t_us = 1'000'000;
  sample.nis = -2;
  const auto bytes = encode(std::vector{sample});
  ASSERT_EQ(bytes.size(), 12U * 8);
  const std::vector<std::uint8_t> one{0, 0, 0, 0, 0, 0, 0xF0, 0x3F}, minus_two{0, 0, 0, 0, 0, 0, 0, 0xC0};
  EXPECT_EQ(std::vector(bytes.begin(), bytes.begin() + 8), one);
  EXPECT_EQ(std::vector(bytes.end() - 8, bytes.end()), minus_two);
}

TEST(Series, ComesBackAsItWas) {
  Sample sample{.t_us = 86'399'999'999,
                .misalignment = {1, 2, 3},
                .angles = {.roll = 4, .pitch = 5, .heading = 6},
                .v_eb_n = {7, 8, 9},
                .attitude_nees = std::numeric_limits<double>::infinity(),
                .nis = std::nan("")};
  const auto back = decode(encode(std::vector{sample, Sample{}}));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].t_us, sample.t_us);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    EXPECT_EQ(value_of(back[0], quantity), static_cast<double>(i + 1)) << name(quantity);
  }
  EXPECT_EQ(value_of(back[0], Quantity::attitude_nees), sample.attitude_nees);
  EXPECT_TRUE(std::isnan(back[0].nis));
}

TEST(Series, HoldsTheFirstAnswerAfterEachUpdate) {
  const auto scenario = scenario::parse(quick_scenario(), "quick.toml", run::contract());
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto truth = run::make_truth(*scenario);
  const auto flown = run::run_in_process(*scenario, *truth, 5);
  ASSERT_TRUE(flown) << flown.error().message;
  const RunSeries series = series_of(5, *flown, *truth);
  EXPECT_EQ(series.run, 5U);
  EXPECT_EQ(series.ending.kind, run::Ending::Kind::completed);
  // 10 Hz for 3 s; the last update is followed by no answer.
  ASSERT_EQ(series.samples.size(), 29U);
  const auto errors = checks::navigation_errors(flown->seen, *truth);
  for (const Sample& sample : series.samples) {
    const auto same_time = [&](const auto& error) { return error.t_us == sample.t_us + 10'000; };
    const auto after = std::ranges::find_if(errors, same_time);
    ASSERT_NE(after, errors.end());
    EXPECT_EQ(sample.angles.heading, after->angles.heading);
    EXPECT_EQ(sample.v_eb_n, after->v_eb_n);
    EXPECT_EQ(sample.misalignment, after->misalignment);
  }
  EXPECT_EQ(series.samples[4].nis, flown->seen.filter[4].nis);
}

}  // namespace
}  // namespace canhil::campaign
