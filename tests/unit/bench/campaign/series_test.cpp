#include "bench/campaign/series.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "tests/unit/bench/campaign/runs.hpp"
#include "tests/unit/bench/checks/fly_past.hpp"

namespace canhil::campaign {
namespace {

TEST(Series, BytesAreDoublesLittleEndian) {
  Samples samples(estimators::inflight_alignment.layout);
  const auto kept = samples.layout().kept;
  add(samples, 1'000'000, {{kept.back(), -2}});
  const auto bytes = encode(samples);
  ASSERT_EQ(bytes.size(), 8 * (1 + kept.size()));
  const std::vector<std::uint8_t> one{0, 0, 0, 0, 0, 0, 0xF0, 0x3F}, minus_two{0, 0, 0, 0, 0, 0, 0, 0xC0};
  EXPECT_EQ(std::vector(bytes.begin(), bytes.begin() + 8), one);
  EXPECT_EQ(std::vector(bytes.end() - 8, bytes.end()), minus_two);
}

TEST(Series, ComesBackAsItWas) {
  for (const estimators::Estimator* estimator : estimators::all()) {
    const quantities::Layout& layout = estimator->layout;
    std::map<const Quantity*, double> values;
    for (const Quantity* quantity : layout.kept)
      values[quantity] = 1.5 * static_cast<double>(values.size() + 1);
    values.begin()->second = std::numeric_limits<double>::infinity();
    std::next(values.begin())->second = std::nan("");
    Samples samples(layout);
    add(samples, -5'540'000, values);
    add(samples, 86'399'999'999, {});
    const auto decoded = decode(encode(samples), layout);
    ASSERT_TRUE(decoded) << decoded.error().message;
    const Samples& back = *decoded;
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(&back.layout(), &layout);
    EXPECT_EQ(back.times()[0], -5'540'000);
    EXPECT_EQ(back.times()[1], 86'399'999'999);
    for (const auto& [quantity, value] : values) {
      const double found = back.value(0, *quantity);
      EXPECT_TRUE(found == value || (std::isnan(found) && std::isnan(value))) << quantity->name;
    }
    EXPECT_EQ(encode(back), encode(samples));
  }
}

TEST(Series, BytesThatAreNoSamplesAreRefused) {
  Samples samples(estimators::wind.layout);
  add(samples, 0, {});
  auto bytes = encode(samples);
  bytes.pop_back();
  EXPECT_EQ(decode(bytes, estimators::wind.layout).error().message, "has 71 bytes of samples of 72 each");
  bytes = encode(samples);
  bytes[7] = 0x7F;  // with the next byte, the time of the sample becomes infinite
  bytes[6] = 0xF0;
  EXPECT_EQ(decode(bytes, estimators::wind.layout).error().message, "has a sample at inf s");
}

TEST(Series, QuantitiesThatFollowFromOthers) {
  Samples alignment(estimators::transfer_alignment.layout);
  add(alignment, 0, {{&quantities::attitude_heading, 6}, {&quantities::heading_sigma, 0.5}});
  EXPECT_EQ(alignment.value(0, quantities::heading_over_sigma), 12);
  EXPECT_TRUE(std::isnan(alignment.value(0, quantities::los_rate_pitch))) << "of another estimator";
  Samples los(estimators::los_rate.layout);
  add(los, 0,
      {{&quantities::los_rate_pitch, 3},
       {&quantities::los_rate_yaw, 4},
       {&quantities::miss_pitch, 3},
       {&quantities::miss_yaw, -4}});
  EXPECT_DOUBLE_EQ(los.value(0, quantities::los_rate_both), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(los.value(0, quantities::miss_distance), 5);
  EXPECT_TRUE(std::isnan(los.value(0, quantities::attitude_heading)));
}

TEST(Series, ALosRateIsSummedUpBySamplesOfTheTimeToGo) {
  checks::Observations seen;
  checks::Flown flown;
  // At 1000 m/s, answers at 100 Hz give two answers for each sample. In each sample, the errors in pitch are
  // 3 and 4 mrad/s, and the errors in yaw are 1 mrad/s.
  for (std::int64_t t_us = 10'000; t_us <= 90'000; t_us += 10'000) {
    flown.epochs.push_back({.t_us = t_us, .range = 100.5 - 1e-3 * static_cast<double>(t_us)});
    estimators::LosAnswer answer;
    answer.cause_us = t_us;
    answer.outcome = messages::LosRateOutcome::updated;
    answer.rate = {.pitch = t_us % 20'000 == 0 ? 4e-3 : -3e-3, .yaw = 1e-3};
    answer.rate_sigma = {.pitch = 1e-3, .yaw = 2e-3};
    answer.nis = t_us % 20'000 == 0 ? 1 : 2;
    seen.of<estimators::LosAnswers>().push_back(answer);
  }
  seen.of<estimators::LosAnswers>()[0].outcome =
      messages::LosRateOutcome::coasting;  // sent, but not from an update
  seen.of<estimators::LosAnswers>()[1].outcome = messages::LosRateOutcome::waiting;
  seen.of<estimators::LosAnswers>()[8].rate.pitch = 1;
  seen.of<estimators::LosAnswers>()[8].blind = true;
  seen.of<estimators::LosAnswers>()[7].degraded = true;
  flown.miss_n = world::Vector3(0, 0.3, -0.4);
  flown.passage_us = 100'500;
  const world::PlantRecord record = flown.record();
  seen.of<estimators::TransferAnswers>().navigation.push_back({});
  const world::FlightRecord rest({.start = {}, .motion = world::Rest{}}, 0, 10'000);
  const RunSeries series{.run = 7,
                         .ending = {},
                         .samples = estimators::los_rate.samples(
                             seen, {.flight = rest, .duration_us = 100'500, .plants = {&record}})};
  ASSERT_EQ(&series.samples.layout(), &estimators::los_rate.layout)
      << "by what was asked for, whatever else was seen";
  // The times to go of the answers, grouped by sample: 90.5, 80.5 | 70.5, 60.5 | 50.5, 40.5 | 30.5, 20.5 |
  // 10.5 ms.
  ASSERT_EQ(series.samples.size(), 5U);
  EXPECT_EQ(series.samples.times()[0], -100'000) << "begins at 100 ms to go";
  EXPECT_EQ(series.samples.times()[4], -20'000);
  EXPECT_DOUBLE_EQ(series.samples.value(0, quantities::los_rate_pitch), 3e-3);
  EXPECT_TRUE(std::isnan(series.samples.value(0, quantities::los_mean_nis)));
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::los_rate_pitch), std::sqrt(12.5) * 1e-3);
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::los_rate_yaw), 1e-3);
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::los_mean_nis), 1.5);
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::los_rate_sigma), std::sqrt(2.5) * 1e-3);
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::los_rate_over_sigma), std::sqrt(25.5 / 4));
  EXPECT_DOUBLE_EQ(series.samples.value(0, quantities::trusted_over_sigma), 3);
  EXPECT_DOUBLE_EQ(series.samples.value(1, quantities::trusted_over_sigma), 4);
  EXPECT_DOUBLE_EQ(series.samples.value(3, quantities::trusted_over_sigma), 3)
      << "it says that it is degraded";
  EXPECT_DOUBLE_EQ(series.samples.value(4, quantities::trusted_over_sigma), 0)
      << "blind answers are not judged";
  EXPECT_DOUBLE_EQ(series.samples.value(2, quantities::miss_pitch), -0.4);
  EXPECT_DOUBLE_EQ(series.samples.value(2, quantities::miss_distance), 0.5);
}

TEST(Series, HoldsTheFirstAnswerAfterEachUpdate) {
  const auto scenario = scenario::parse(quick_scenario(), "quick.toml", drive::contract());
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto truth = drive::make_truth(*scenario);
  const auto flown = drive::run_in_process(*scenario, *truth, 5);
  ASSERT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, drive::Ending::Kind::completed);
  const Samples samples =
      samples_of(flown->seen, flown->per_run_truth, *truth, estimators::transfer_alignment);
  // 10 Hz for 3 s; no answer follows the last update.
  ASSERT_EQ(samples.size(), 29U);
  const auto errors = flown->seen.of<estimators::TransferAnswers>().navigation.errors(*truth);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto same_time = [&](const auto& error) { return error.t_us == samples.times()[i] + 10'000; };
    const auto after = std::ranges::find_if(errors, same_time);
    ASSERT_NE(after, errors.end());
    const auto value = [&](const Quantity& quantity) { return samples.value(i, quantity); };
    EXPECT_EQ(value(quantities::attitude_heading), after->angles.heading);
    EXPECT_EQ(value(quantities::attitude_roll), after->angles.roll);
    EXPECT_EQ(value(quantities::velocity_east), after->v_eb_n.y());
    EXPECT_EQ(value(quantities::velocity_down), after->v_eb_n.z());
    EXPECT_EQ(value(quantities::misalignment_north), after->misalignment.x());
    EXPECT_TRUE(std::isnan(value(quantities::position_north)));
  }
  EXPECT_EQ(samples.value(4, quantities::innovation_nis),
            flown->seen.of<estimators::TransferAnswers>().filter[4].nis);
}

TEST(Series, AFixHasAPositionAndASigmaButNoCovariance) {
  const world::Position start{.latitude = 0.6, .longitude = 2, .height = 5};
  const world::FlightRecord truth({.start = start, .motion = world::Rest{}}, 3'000'000, 20'000);
  drive::Collected flown{.ending = {}, .seen = {}};
  for (const std::int64_t t_us : {1'000'000, 1'500'000, 2'000'000})
    flown.seen.of<estimators::InflightAnswers>().navigation.push_back(
        {.cause_us = t_us, .angles = {.heading = 1e-6 * static_cast<double>(t_us)}});
  estimators::FixAnswer fix{.cause_us = 500'000, .navigation_us = 1'000'000, .nis = 4};
  fix.position = displaced(start, {1, 2, 3});
  fix.attitude_sigma.z() = 0.5;
  fix.repairs = 6;
  flown.seen.of<estimators::InflightAnswers>().fixes.push_back(fix);
  fix.outcome = messages::FixOutcome::wrong_source;
  flown.seen.of<estimators::InflightAnswers>().fixes.push_back(fix);
  fix.outcome = messages::FixOutcome::gated;
  fix.cause_us = 1'500'000;
  fix.nis = 900;
  flown.seen.of<estimators::InflightAnswers>().fixes.push_back(fix);
  const Samples samples = samples_of(flown.seen, flown.per_run_truth, truth, estimators::inflight_alignment);
  ASSERT_EQ(samples.size(), 2U) << "only of fixes that were considered";
  EXPECT_TRUE(std::isnan(samples.value(1, quantities::innovation_nis))) << "the filter did not use it";
  const auto value = [&](const Quantity& quantity) { return samples.value(0, quantity); };
  EXPECT_EQ(samples.times()[0], 500'000);
  EXPECT_DOUBLE_EQ(value(quantities::attitude_heading), 1.5) << "the first answer that knew of a late fix";
  EXPECT_NEAR(value(quantities::position_north), 1, 1e-6);
  EXPECT_NEAR(value(quantities::position_down), 3, 1e-6);
  EXPECT_DOUBLE_EQ(value(quantities::heading_over_sigma), 3);
  EXPECT_EQ(value(quantities::covariance_repairs), 6);
  EXPECT_EQ(value(quantities::innovation_nis), 4);
  EXPECT_TRUE(std::isnan(value(quantities::attitude_nees)));
}

}  // namespace
}  // namespace canhil::campaign
