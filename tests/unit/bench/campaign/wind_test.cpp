// Campaigns of the wind: the mean error of a run, and the stored samples of a run.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "bench/campaign/divergence.hpp"
#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/statistics.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/estimators/wind/answers.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

constexpr std::int64_t end_us = 1'000'000;

std::vector<RunSeries> three_runs() {
  // Means of |value| from 0.2 s on: 2, 4, 6.
  return {run_with(0, {90, 1, -3}, quantities::wind_along), run_with(1, {90, -4, 4}, quantities::wind_along),
          run_with(2, {90, 6, 6}, quantities::wind_along)};
}

TEST(RunMeans, AreOfEachRunOverTheWindow) {
  const RunMeans found = run_means(three_runs(), quantities::wind_along, 200'000, end_us);
  EXPECT_DOUBLE_EQ(found.mean, 4);
  EXPECT_DOUBLE_EQ(found.standard_deviation, 2);
  EXPECT_DOUBLE_EQ(found.largest, 6);
  EXPECT_EQ(found.missing, 0U);
  EXPECT_DOUBLE_EQ(run_means(three_runs(), quantities::wind_along, 0, 100'000).mean, 90);
}

TEST(RunMeans, CountRunsThatWereLost) {
  auto runs = three_runs();
  runs[1].ending.kind = drive::Ending::Kind::target_silent;
  runs[2] = run_with(2, {1, std::numeric_limits<double>::quiet_NaN(), 1}, quantities::wind_along);
  const RunMeans found = run_means(runs, quantities::wind_along, 200'000, end_us);
  EXPECT_EQ(found.missing, 2U);
  EXPECT_DOUBLE_EQ(found.mean, 2);
  EXPECT_TRUE(std::isnan(found.standard_deviation));
  EXPECT_EQ(run_means(three_runs(), quantities::wind_along, 500'000, end_us).missing,
            3U);  // there are no updates in this window
}

// The mean heading error of A is 2 mrad; the mean heading error of B is 6 mrad.
std::optional<bool> passed(const std::string& metric) {
  const auto campaign =
      parse(two_variants + "[[metric]]\nkind = 'run_mean'\nquantity = 'attitude.heading'\n" + metric);
  EXPECT_TRUE(campaign) << campaign.error().message;
  const auto evaluation = evaluate(*campaign, [](std::size_t variant) -> Result<std::vector<RunSeries>> {
    std::vector<RunSeries> runs;
    for (std::uint64_t run = 0; run < 4; ++run)
      runs.push_back(run_with(run, held(variant == 0 ? std::vector{1e-3, -3e-3, 2e-3} : std::vector{6e-3})));
    return runs;
  });
  EXPECT_TRUE(evaluation) << evaluation.error().message;
  return evaluation->answers.at(0).passed;
}

TEST(RunMean, Bars) {
  EXPECT_EQ(passed(""), std::nullopt);
  EXPECT_EQ(passed("at_most_mrad = 2.01\n"), true);
  EXPECT_EQ(passed("at_most_mrad = 1.99\n"), false);
  EXPECT_EQ(passed("at_least_mrad = 2.01\n"), false);
  EXPECT_EQ(passed("other = 'B'\nratio_at_most = 0.34\n"), true);
  EXPECT_EQ(passed("other = 'B'\nratio_at_most = 0.33\n"), false);
  EXPECT_EQ(passed("other = 'B'\nratio_at_least = 0.34\n"), false);
  EXPECT_EQ(passed("from_s = 0.2\nto_s = 0.25\nother = 'B'\nratio_at_least = 0.49\n"), true);
}

TEST(RunMean, ARatioNeedsAnother) {
  const auto campaign = parse(
      two_variants + "[[metric]]\nkind = 'run_mean'\nquantity = 'attitude.heading'\nratio_at_most = 0.5\n");
  ASSERT_FALSE(campaign);
  EXPECT_THAT(campaign.error().message, testing::HasSubstr("metric[1].ratio_at_most': has no effect alone"));
}

TEST(WindSeries, IsWhatTheChecksSee) {
  auto scenario = scenario::read_file(SOURCE_DIR "/bench/flights/wind_quick.toml", drive::contract()).value();
  EXPECT_EQ(&estimators::of(scenario), &estimators::wind);
  const auto truth = drive::make_truth(scenario);
  const auto flown = drive::run_in_process(scenario, *truth, 2);
  ASSERT_TRUE(flown) << flown.error().message;
  const Samples samples = samples_of(flown->seen, flown->per_run_truth, *truth, estimators::of(scenario));
  const auto air = estimators::TrueAir::find(drive::plants_of(flown->per_run_truth), estimators::true_air);
  ASSERT_TRUE(air);
  const auto errors = estimators::wind_errors(flown->seen.of<estimators::WindAnswers>(), *air);
  ASSERT_EQ(&samples.layout(), &estimators::wind.layout);
  EXPECT_TRUE(samples_of(flown->seen, flown->per_run_truth, *truth, estimators::los_rate).empty())
      << "flew no engagement";
  ASSERT_EQ(samples.size(), errors.size());
  const std::size_t last = errors.size() - 1;
  const auto value = [&](const Quantity& quantity) { return samples.value(last, quantity); };
  EXPECT_EQ(samples.times()[last], errors[last].t_us);
  EXPECT_EQ(value(quantities::wind_along), errors[last].along_track);
  EXPECT_EQ(value(quantities::wind_cross), errors[last].cross_track);
  EXPECT_EQ(value(quantities::wind_down), errors[last].error_n.z());
  EXPECT_NEAR(value(quantities::wind_norm), errors[last].error_n.norm(), 1e-12);
  EXPECT_EQ(value(quantities::wind_nis), flown->seen.of<estimators::WindAnswers>().back().nis);
  EXPECT_GT(value(quantities::wind_nees), 0);
  EXPECT_EQ(value(quantities::wind_along_sigma),
            flown->seen.of<estimators::WindAnswers>().back().along_track_sigma);
}

}  // namespace
}  // namespace canhil::campaign
