// Statistics against values computed by hand.
#include "bench/campaign/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr const Quantity& heading = quantities::attitude_heading;

TEST(RmsCurve, IsTheRootOfTheMeanSquareOverRuns) {
  const std::vector runs{run_with(0, {3, 1}), run_with(1, {-4, 7})};
  const auto curve = rms_curve(runs, heading);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0].t_us, 100'000);
  EXPECT_DOUBLE_EQ(curve[0].rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(curve[1].rms, 5);
  EXPECT_EQ(curve[1].runs, 2U);
  EXPECT_EQ(curve[1].missing, 0U);
}

TEST(RmsCurve, HasTheStandardErrorThatTheScatterOverTheRunsGivesIt) {
  const std::vector runs{run_with(0, {3, 2}), run_with(1, {-4, -2})};
  const auto curve = rms_curve(runs, heading);
  // The mean of the squares 9 and 16 has the standard error sqrt(24.5 / 2) = 3.5. The standard error of the
  // RMS is 3.5 / (2 RMS).
  EXPECT_DOUBLE_EQ(curve[0].rms_error, 3.5 / (2 * std::sqrt(12.5)));
  EXPECT_EQ(curve[1].rms_error, 0) << "all alike";
  EXPECT_TRUE(std::isnan(rms_curve(std::vector{run_with(0, {3})}, heading)[0].rms_error)) << "one run";
}

TEST(RmsCurve, CountsRunsThatEndedOrAreNotFinite) {
  const std::vector runs{run_with(0, {3, 1}), ended_with(1, {4}), run_with(2, {nan, 1})};
  const auto curve = rms_curve(runs, heading);
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_EQ(curve[0].missing, 1U);
  EXPECT_DOUBLE_EQ(curve[0].rms, std::sqrt(12.5));
  EXPECT_EQ(curve[1].missing, 1U);
  EXPECT_DOUBLE_EQ(curve[1].rms, 1);
}

TEST(TimeWithin, IsTheFirstUpdateAfterWhichItStaysWithin) {
  EXPECT_EQ(time_within(rms_curve(std::vector{run_with(0, {1, 9, 2, 2})}, heading), 2), 0.3);
  EXPECT_EQ(time_within(rms_curve(std::vector{run_with(0, {1, 1})}, heading), 2), 0.1);
  EXPECT_EQ(time_within(rms_curve(std::vector{run_with(0, {1, 1, 3})}, heading), 2), std::nullopt);
  EXPECT_EQ(time_within({}, 2), std::nullopt);
}

TEST(TimeWithin, IsNeverWhileARunIsMissing) {
  EXPECT_EQ(time_within(rms_curve(std::vector{run_with(0, {1, 1, 1}), ended_with(1, {1, 1})}, heading), 2),
            std::nullopt);
  EXPECT_EQ(time_within(rms_curve(std::vector{run_with(0, {1, 1}), run_with(1, {nan, 1})}, heading), 2), 0.2);
}

TEST(ValueAt, IsTheLastUpdateAtOrBefore) {
  const auto curve = rms_curve(std::vector{run_with(0, {1, 2, 3})}, heading);
  EXPECT_EQ(value_at(curve, 200'000)->rms, 2);
  EXPECT_EQ(value_at(curve, 299'999)->rms, 2);
  EXPECT_EQ(value_at(curve, 99'999), std::nullopt);
}

TEST(RunDistribution, IsOfEachRunsLastUpdateAtOrBeforeTheTime) {
  std::vector<RunSeries> runs;
  for (std::uint64_t run = 0; run < 10; ++run)
    runs.push_back(
        run_with(run, {99, run % 2 == 0 ? static_cast<double>(run + 1) : -static_cast<double>(run + 1), 99}));
  runs[3] = run_with(3, {4});  // the second fix was lost, so the previous value is used
  const auto found = run_distribution(runs, heading, 250'000, 5, 100);
  EXPECT_EQ(found.missing, 0U);
  EXPECT_DOUBLE_EQ(found.rms, std::sqrt(38.5));
  EXPECT_DOUBLE_EQ(found.mean, 5.5);
  EXPECT_DOUBLE_EQ(found.median, 5.5) << "the mean of the two middles";
  EXPECT_DOUBLE_EQ(found.p90, 9);
  EXPECT_DOUBLE_EQ(found.below, 0.4);
}

TEST(RunDistribution, TheMedianOfAnOddNumberIsTheMiddle) {
  EXPECT_DOUBLE_EQ(run_distribution(std::vector{run_with(0, {7}), run_with(1, {-2}), run_with(2, {1})},
                                    heading, 100'000, 1, 100)
                       .median,
                   2);
}

TEST(RunDistribution, ABatchHasNoMoreRunsThanThereAre) {
  std::vector<RunSeries> runs;
  for (std::uint64_t run = 0; run < 20; ++run) runs.push_back(run_with(run, {run % 4 == 0 ? 10.0 : 0.0}));
  const auto found = run_distribution(runs, heading, 100'000, 1, 100);
  EXPECT_EQ(found.batch, 20U);
  EXPECT_EQ(found.rms_high, run_distribution(runs, heading, 100'000, 1, 20).rms_high);
  EXPECT_EQ(run_distribution(runs, heading, 100'000, 1, 5).batch, 5U);
}

TEST(RunDistribution, BootstrapsTheRmsOfABatch) {
  std::vector<RunSeries> runs;
  for (std::uint64_t run = 0; run < 400; ++run) runs.push_back(run_with(run, {run % 4 == 0 ? 10.0 : 0.0}));
  const auto found = run_distribution(runs, heading, 100'000, 1, 100);
  // A quarter of the runs have the value 10, so the number of such runs among 100 drawn runs has the
  // distribution B(100, 1/4). The 5 % quantile of this distribution is 18, and its 95 % quantile is 32.
  EXPECT_NEAR(found.rms_low, std::sqrt(18.0), 0.13);
  EXPECT_NEAR(found.rms_high, std::sqrt(32.0), 0.13);
  EXPECT_EQ(run_distribution(runs, heading, 100'000, 1, 100).rms_low, found.rms_low) << "seeded";
  EXPECT_LT(run_distribution(runs, heading, 100'000, 1, 1000).rms_high, found.rms_high);
}

TEST(RunDistribution, CountsRunsThatHadEndedOrAreNotFinite) {
  std::vector<RunSeries> runs{run_with(0, {1, 2}), run_with(1, {1}), run_with(2, {1, nan}), run_with(3, {})};
  runs[1].ending = {.kind = drive::Ending::Kind::target_fault, .t_us = 150'000, .detail = ""};
  const auto found = run_distribution(runs, heading, 200'000, 5, 100);
  EXPECT_EQ(found.missing, 3U);
  EXPECT_DOUBLE_EQ(found.rms, 2);
  EXPECT_DOUBLE_EQ(found.below, 0.25) << "of all runs";
  EXPECT_EQ(run_distribution(runs, heading, 100'000, 5, 100).missing, 1U) << "it had not ended then";
}

TEST(WindowStatistics, AreMeanAndStandardDeviationOverRunsAndTime) {
  const std::vector runs{run_with(0, {99, 2, 4, 99}), run_with(1, {99, 4, 6, 99})};
  const auto found = window_statistics(runs, heading, 200'000, 300'000);
  EXPECT_EQ(found.count, 4U);
  EXPECT_DOUBLE_EQ(found.mean, 4);
  EXPECT_DOUBLE_EQ(found.standard_deviation, std::sqrt(8.0 / 3));
  EXPECT_EQ(
      window_statistics(std::vector{run_with(0, {1, 2}), ended_with(1, {1})}, heading, 0, 1'000'000).missing,
      1U);
}

TEST(PairedFraction, ComparesMagnitudesOfTheSameRun) {
  const std::vector a{run_with(0, {1}), run_with(1, {-1}), run_with(2, {3}), run_with(4, {0})};
  const std::vector b{run_with(0, {-2}), run_with(1, {2}), run_with(2, {2}), run_with(3, {9})};
  const auto paired = paired_fraction(a, b, heading, 100'000, 0.95);
  EXPECT_EQ(paired.pairs, 3U);
  EXPECT_EQ(paired.better, 2U);
  EXPECT_DOUBLE_EQ(paired.fraction, 2.0 / 3);
  // The interval of Clopper and Pearson (1934) at 95 %, for 2 of 3 runs.
  EXPECT_NEAR(paired.low, 0.0943, 5e-5);
  EXPECT_NEAR(paired.high, 0.9916, 5e-5);
}

TEST(PairedFraction, NoValueIsWorseThanAny) {
  const std::vector good{run_with(0, {5, 5})}, ended{ended_with(0, {1}), run_with(1, {1, 1})};
  EXPECT_EQ(paired_fraction(good, ended, heading, 200'000, 0.9).better, 1U);
  EXPECT_EQ(paired_fraction(ended, good, heading, 200'000, 0.9).better, 0U);
  const std::vector lost{run_with(0, {nan, nan})};
  EXPECT_EQ(paired_fraction(lost, lost, heading, 200'000, 0.9).better, 0U);
}

TEST(PairedFraction, AllBetterIsBoundedBelowOnly) {
  std::vector<RunSeries> a, b;
  for (std::uint64_t run = 0; run < 20; ++run) {
    a.push_back(run_with(run, {1}));
    b.push_back(run_with(run, {2}));
  }
  const auto paired = paired_fraction(a, b, heading, 100'000, 0.95);
  EXPECT_NEAR(paired.low, std::pow(0.025, 1.0 / 20), 1e-9);  // p^20 = 2.5 %
  EXPECT_DOUBLE_EQ(paired.high, 1);
}

TEST(Consistency, HasTheBoundsOfChiSquareForTheMeanOverRuns) {
  std::vector<RunSeries> runs(10, run_with(0, {3, 9}, quantities::innovation_nis));
  const auto found = consistency(runs, quantities::innovation_nis, 0, 1'000'000, 0.95);
  EXPECT_DOUBLE_EQ(found.mean, 6);
  EXPECT_NEAR(found.low, 1.6791, 1e-4);   // chi2(30) at 2.5 %: 16.791
  EXPECT_NEAR(found.high, 4.6979, 1e-4);  // at 97.5 %: 46.979
  EXPECT_EQ(found.updates, 2U);
  EXPECT_DOUBLE_EQ(found.inside, 0.5);
  runs[3] = run_with(3, {inf, 9}, quantities::innovation_nis);
  EXPECT_EQ(consistency(runs, quantities::innovation_nis, 0, 1'000'000, 0.95).missing, 1U);
  EXPECT_DOUBLE_EQ(consistency(runs, quantities::innovation_nis, 0, 1'000'000, 0.95).inside, 0);
}

TEST(Consistency, IsOfTheRunsThatWereAsked) {
  // At the second update, the gate rejected the fixes of all runs except one. At the third update, the gate
  // rejected the fixes of all runs.
  std::vector<RunSeries> runs(10, run_with(0, {3, nan, nan}, quantities::innovation_nis));
  runs[4] = run_with(4, {3, 9.3, nan}, quantities::innovation_nis);
  const auto found = consistency(runs, quantities::innovation_nis, 0, 1'000'000, 0.95);
  EXPECT_EQ(found.missing, 0U);
  EXPECT_EQ(found.updates, 2U);
  EXPECT_DOUBLE_EQ(found.mean, (30 + 9.3) / 11);
  EXPECT_DOUBLE_EQ(found.inside, 1) << "of one run 9.3 is: chi2(3) at 97.5 % is 9.348";
  EXPECT_NEAR(found.low, 1.6791, 1e-4) << "of all runs";
}

RunSeries engagement(std::uint64_t run, const std::map<std::int64_t, double>& pitch_by_ms_to_go) {
  RunSeries series{.run = run, .ending = {}, .samples = Samples(estimators::los_rate.layout)};
  for (const auto& [ms, pitch] : pitch_by_ms_to_go)
    add(series.samples, -1000 * ms, {{&quantities::los_rate_pitch, pitch}});
  return series;
}

TEST(ToGo, TakesTheSamplesThatLieWithinTheWindow) {
  std::map<std::int64_t, double> values{{-1000, 9}, {-520, 5}, {-500, 3}, {-220, 4}, {-200, 7}};
  std::map<std::int64_t, double> to_go;
  for (const auto& [ms, value] : values) to_go[-ms] = value;
  std::vector<RunSeries> runs{engagement(0, to_go), engagement(1, to_go)};
  const auto found = to_go_statistics(runs, quantities::los_rate_pitch, 0.2, 0.5);
  EXPECT_EQ(found.count, 4U) << "that from 0.5 s on, and that down to 0.2 s, of both";
  EXPECT_DOUBLE_EQ(found.mean, 3.5);
  EXPECT_DOUBLE_EQ(found.rms, std::sqrt(12.5));
  EXPECT_EQ(found.missing, 0U);
  EXPECT_DOUBLE_EQ(to_go_statistics(runs, quantities::los_rate_both, 0.2, 0.5).rms, std::sqrt(12.5 / 2))
      << "yaw is 0";
  runs[1] = engagement(1, {{1000, 9}});
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0.2, 0.5).missing, 1U);
  runs[0].ending.kind = drive::Ending::Kind::target_fault;
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0.2, 0.5).missing, 2U);
}

}  // namespace
}  // namespace canhil::campaign
