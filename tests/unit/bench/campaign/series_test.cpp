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
  sample.repairs = -2;
  const auto bytes = encode(std::vector{sample});
  ASSERT_EQ(bytes.size(), 17U * 8);
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
                .nis = std::nan(""),
                .position = {10, 11, 12},
                .heading_sigma = 0.5,
                .repairs = 14};
  const auto back = decode(encode(std::vector{sample, Sample{}}));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].t_us, sample.t_us);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    EXPECT_EQ(value_of(back[0], quantity), static_cast<double>(i + 1)) << name(quantity);
  }
  EXPECT_EQ(value_of(back[0], Quantity::p_north), 10);
  EXPECT_EQ(value_of(back[0], Quantity::p_east), 11);
  EXPECT_EQ(value_of(back[0], Quantity::p_down), 12);
  EXPECT_EQ(value_of(back[0], Quantity::heading_over_sigma), 12);
  EXPECT_EQ(value_of(back[0], Quantity::repairs), 14);
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

TEST(Series, AFixHasAPositionAndASigmaButNoCovariance) {
  const world::Position start{.latitude = 0.6, .longitude = 2, .height = 5};
  const world::FlightRecord truth({.start = start, .motion = world::Rest{}}, 3'000'000, 20'000);
  run::InProcessRun flown{.ending = {}, .seen = {}};
  for (const std::int64_t t_us : {1'000'000, 1'500'000, 2'000'000})
    flown.seen.navigation.push_back(
        {.cause_us = t_us, .angles = {.heading = 1e-6 * static_cast<double>(t_us)}});
  checks::FixAnswer fix{.cause_us = 500'000, .navigation_us = 1'000'000, .nis = 4};
  fix.position = displaced(start, {1, 2, 3});
  fix.heading_sigma = 0.5;
  fix.repairs = 6;
  flown.seen.fixes.push_back(fix);
  fix.outcome = messages::FixOutcome::wrong_source;
  flown.seen.fixes.push_back(fix);
  const RunSeries series = series_of(5, flown, truth);
  ASSERT_EQ(series.samples.size(), 1U) << "only of fixes that were considered";
  const Sample& sample = series.samples[0];
  EXPECT_EQ(sample.t_us, 500'000);
  EXPECT_DOUBLE_EQ(sample.angles.heading, 1.5) << "the first answer that knew of a late fix";
  EXPECT_LT((sample.position - world::Vector3(1, 2, 3)).norm(), 1e-6);
  EXPECT_DOUBLE_EQ(value_of(sample, Quantity::heading_over_sigma), 3);
  EXPECT_EQ(sample.repairs, 6);
  EXPECT_EQ(sample.nis, 4);
  EXPECT_TRUE(std::isnan(sample.attitude_nees));
}

}  // namespace
}  // namespace canhil::campaign
