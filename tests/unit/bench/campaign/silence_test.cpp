// A target that falls silent fails every limit: an estimate is used only until it reaches its age limit.
#include <gmock/gmock.h>

#include <cmath>

#include "bench/campaign/divergence.hpp"
#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/statistics.hpp"
#include "bench/drive/contract.hpp"
#include "tests/unit/bench/campaign/runs.hpp"

namespace canhil::campaign {
namespace {

constexpr const Quantity& heading = quantities::attitude_heading;
constexpr std::int64_t s_us = 1'000'000;
constexpr std::int64_t end_us = 10 * s_us;

/// The value 1 every half second from 0.5 s on, except during a silence.
RunSeries run_silent(std::int64_t from_us, std::int64_t to_us, const Quantity& quantity = heading) {
  RunSeries series{.run = 0,
                   .ending = {},
                   .samples = Samples(layout_with(quantity)),
                   .freshness = {.age_limit_us = s_us, .end_us = end_us}};
  for (std::int64_t t_us = s_us / 2; t_us <= end_us; t_us += s_us / 2) {
    if (t_us <= from_us || t_us >= to_us) add(series.samples, t_us, {{&quantity, 1}});
  }
  return series;
}

const std::vector never_silent{run_silent(end_us, end_us)}, at_the_end{run_silent(3 * s_us, end_us + 1)},
    in_between{run_silent(3 * s_us, 6 * s_us)};

TEST(Silence, LeavesNothingMissingWhereThereIsNone) {
  EXPECT_EQ(value_at(rms_curve(never_silent, heading), end_us)->missing, 0U);
  EXPECT_EQ(rms_curve(never_silent, heading).size(), 20U);
  EXPECT_EQ(run_distribution(never_silent, heading, end_us, 2, 1).missing, 0U);
  EXPECT_EQ(window_statistics(never_silent, heading, 0, end_us).missing, 0U);
  EXPECT_EQ(run_means(never_silent, heading, 0, end_us).missing, 0U);
  EXPECT_EQ(divergence(never_silent, heading, 2).beyond, 0U);
}

TEST(Silence, AValueThatIsStaleIsMissing) {
  const auto curve = rms_curve(at_the_end, heading);
  EXPECT_EQ(value_at(curve, 3'900'000)->rms, 1) << "not yet";
  EXPECT_TRUE(std::isnan(value_at(curve, 4'100'000)->rms));
  EXPECT_EQ(value_at(curve, end_us)->missing, 1U);
  EXPECT_EQ(run_distribution(at_the_end, heading, 4 * s_us, 2, 1).missing, 0U);
  EXPECT_EQ(run_distribution(at_the_end, heading, 4'000'001, 2, 1).missing, 1U);
  EXPECT_EQ(paired_fraction(at_the_end, never_silent, heading, end_us, 0.9).better, 0U);
  EXPECT_EQ(paired_fraction(never_silent, at_the_end, heading, end_us, 0.9).better, 1U);
  EXPECT_EQ(divergence(at_the_end, heading, 2).beyond, 1U);
}

TEST(Silence, IsNotWithinForGood) {
  EXPECT_EQ(time_within(rms_curve(never_silent, heading), 2), 0.5);
  EXPECT_EQ(time_within(rms_curve(at_the_end, heading), 2), std::nullopt);
  EXPECT_EQ(time_within(rms_curve(in_between, heading), 2), 6.0);
}

TEST(Silence, OfAStretchOfAWindowIsMissing) {
  for (const auto& runs : {at_the_end, in_between}) {
    EXPECT_GT(window_statistics(runs, heading, 0, end_us).missing, 0U);
    EXPECT_EQ(run_means(runs, heading, 0, end_us).missing, 1U);
    EXPECT_EQ(run_means(runs, heading, 0, 3 * s_us).missing, 0U) << "before it";
  }
  EXPECT_EQ(run_means(in_between, heading, 6 * s_us, end_us).missing, 0U) << "after it";
  EXPECT_EQ(run_means(in_between, heading, 4 * s_us, end_us).missing, 1U) << "at the window's beginning";
  EXPECT_GT(window_statistics(in_between, heading, 4 * s_us, end_us).missing, 0U);
  const std::vector nis{run_silent(3 * s_us, 6 * s_us, quantities::innovation_nis)};
  EXPECT_GT(consistency(nis, quantities::innovation_nis, 0, end_us, 0.95).missing, 0U);
  EXPECT_EQ(consistency(nis, quantities::innovation_nis, 6 * s_us, end_us, 0.95).missing, 0U);
}

TEST(Silence, OfOneRunIsMissingBesideOthers) {
  const std::vector runs{never_silent[0], at_the_end[0]};
  EXPECT_EQ(value_at(rms_curve(runs, heading), end_us)->missing, 1U);
  EXPECT_EQ(run_means(runs, heading, 0, end_us).missing, 1U);
  EXPECT_EQ(run_distribution(runs, heading, end_us, 2, 1).missing, 1U);
}

/// Two runs with fixes every half second; in the second run, the fixes at 3 and 3.5 s were lost.
std::vector<RunSeries> with_lost_fixes(const Quantity& quantity) {
  return {run_silent(end_us, end_us, quantity), run_silent(5 * s_us / 2, 4 * s_us, quantity)};
}

TEST(LostFixes, LeaveTheEstimateBeforeThem) {
  const auto runs = with_lost_fixes(heading);
  for (std::int64_t t_us = s_us / 2; t_us <= end_us; t_us += s_us / 2)
    EXPECT_EQ(value_at(rms_curve(runs, heading), t_us)->missing, 0U) << t_us;
  EXPECT_EQ(time_within(rms_curve(runs, heading), 2), 0.5);
  const std::vector lost{runs.back()};
  std::vector twice{runs.front()};
  twice.front().samples = Samples(estimators::transfer_alignment.layout);
  for (std::int64_t t_us = s_us / 2; t_us <= end_us; t_us += s_us / 2)
    add(twice.front().samples, t_us, {{&heading, 2}});
  EXPECT_EQ(paired_fraction(lost, twice, heading, 3 * s_us, 0.9).better, 1U);
  EXPECT_EQ(paired_fraction(twice, lost, heading, 3 * s_us, 0.9).better, 0U);
}

TEST(LostFixes, AreNoUpdatesOfAWindow) {
  const auto window = window_statistics(with_lost_fixes(heading), heading, 0, end_us);
  EXPECT_EQ(window.missing, 0U);
  EXPECT_EQ(window.count, 38U);
  const auto nis =
      consistency(with_lost_fixes(quantities::innovation_nis), quantities::innovation_nis, 0, end_us, 0.95);
  EXPECT_EQ(nis.missing, 0U);
  EXPECT_EQ(nis.updates, 20U);
  EXPECT_EQ(nis.mean, 1);
}

TEST(LostFixes, TooManyInARowAreASilence) {
  // One run is silent for 2 s; the age limit is 1 s.
  const std::vector runs{run_silent(end_us, end_us), run_silent(2 * s_us, 4 * s_us)};
  EXPECT_EQ(value_at(rms_curve(runs, heading), 3 * s_us)->missing, 0U);
  EXPECT_EQ(value_at(rms_curve(runs, heading), 7 * s_us / 2)->missing, 1U);
  EXPECT_EQ(window_statistics(runs, heading, 0, end_us).missing, 1U);
  const std::vector nis{run_silent(end_us, end_us, quantities::innovation_nis),
                        run_silent(2 * s_us, 4 * s_us, quantities::innovation_nis)};
  EXPECT_EQ(consistency(nis, quantities::innovation_nis, 0, end_us, 0.95).missing, 1U);
}

TEST(Silence, AMissDoesNotAge) {
  RunSeries series{.run = 0,
                   .ending = {},
                   .samples = Samples(estimators::los_rate.layout),
                   .freshness = {.age_limit_us = s_us, .end_us = 0}};
  add(series.samples, -5 * s_us, {{&quantities::miss_pitch, 3}, {&quantities::miss_yaw, 4}});
  EXPECT_EQ(run_distribution(std::vector{series}, quantities::miss_distance, end_us, 6, 1).missing, 0U);
  EXPECT_EQ(run_distribution(std::vector{series}, quantities::los_rate_pitch, end_us, 6, 1).missing, 1U);
}

TEST(Silence, HalfOfTheSamplesToGoMustBeAnswered) {
  RunSeries series{
      .run = 0,
      .ending = {},
      .samples = Samples(estimators::los_rate.layout),
      .freshness = {
          .end_us = 0, .begin_us = -2 * s_us, .sample_us = estimators::los_rate.layout.to_go_stretch_us}};
  for (int i = 50; i > 20; --i)
    add(series.samples, -i * estimators::los_rate.layout.to_go_stretch_us,
        {{&quantities::los_rate_pitch, 1}});
  const std::vector runs{series};
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0, 1).missing, 0U) << "30 of 50";
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0, 0.7).missing, 1U) << "15 of 35";
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0.4, 9).missing, 1U) << "30 of 80";
  EXPECT_EQ(to_go_statistics(runs, quantities::los_rate_pitch, 0.8, 9).missing, 1U) << "10 of 60";
}

TEST(Silence, OfAFilterThatCoastsIsThatOfItsNis) {
  RunSeries series{.run = 0,
                   .ending = {},
                   .samples = Samples(estimators::wind.layout),
                   .freshness = {.age_limit_us = s_us, .end_us = end_us}};
  for (std::int64_t t_us = s_us / 10; t_us <= end_us; t_us += s_us / 10)
    add(series.samples, t_us,
        {{&quantities::wind_nis, t_us > 3 * s_us && t_us <= 5 * s_us ? std::nan("") : 9.0}});
  const std::vector runs{series};
  EXPECT_EQ(consistency(runs, quantities::wind_nis, 0, 4 * s_us, 0.95).missing, 0U) << "for a second";
  EXPECT_EQ(consistency(runs, quantities::wind_nis, 0, end_us, 0.95).missing, 10U);
}

std::int64_t age_limit_us(const std::string& scenario, const std::vector<scenario::Setting>& settings = {}) {
  const std::string file = SOURCE_DIR "/bench/flights/" + scenario;
  const auto read = scenario::parse(content(file), file, drive::contract(), settings);
  EXPECT_TRUE(read) << read.error().message;
  return estimators::of(*read).freshness(*read).age_limit_us;
}

scenario::Setting set(const std::string& key, const std::string& value) {
  return {.key = key, .value = value, .elements = {}, .line = 1};
}

TEST(Freshness, IsTwoPeriodsOrASecondInWhichAnAnswerWasDue) {
  EXPECT_EQ(age_limit_us("transfer_alignment_quick.toml"), s_us + 100'000);
  EXPECT_EQ(age_limit_us("transfer_alignment_quick.toml", {set("master_ins.period_ms", "2000")}), 4 * s_us);
  EXPECT_EQ(age_limit_us("los_quick.toml", {set("seeker.period_ms", "10")}), s_us + 10'000);
  EXPECT_EQ(age_limit_us("wind_quick.toml", {set("glider_nav.period_ms", "50")}), s_us + 50'000);
  EXPECT_EQ(age_limit_us("wind_quick.toml", {set("target.parameters.output_interval_ms", "100")}),
            s_us + 100'000);
}

TEST(Freshness, LetsPassTwoFixesInARowAndWhatIsLostOnPurpose) {
  const auto with = [](const std::string& key, const std::string& value,
                       const std::string& latency_ms = "0") {
    return age_limit_us("inflight_gps.toml",
                        {set("gps.period_ms", "1000"), set("gps.latency_ms", latency_ms), set(key, value)});
  };
  EXPECT_EQ(with("gps.loss_percent", "0"), 3 * s_us);
  EXPECT_EQ(with("gps.loss_percent", "0", "500"), 3'500'000);
  EXPECT_EQ(with("gps.loss_percent", "20"), 9 * s_us) << "nine in a row: once in a million";
  EXPECT_EQ(with("gps.silence_s", "[1, 300]"), 3 * s_us) << "a silence is not lost at random";
  EXPECT_EQ(age_limit_us("wind_quick.toml",
                         {set("glider_nav.outage_s", "4"), set("glider_nav.outage_every_s", "5")}),
            age_limit_us("wind_quick.toml"))
      << "nor is an outage";
}

// With 10 updates, the values end at 1 s, but the flight lasts 3 s. With 30 updates, there is no silence.
TEST(Silence, MeetsNoBar) {
  for (const std::string metric :
       {"kind = 'value_at'\nat_s = 3.0\nat_most_mrad = 100\n",
        "kind = 'time_within'\nwithin_mrad = 100\nat_most_s = 3.0\n",
        "kind = 'distribution'\nat_s = 3.0\nrms_at_most_mrad = 100\n",
        "kind = 'window'\nmean_at_most_mrad = 100\n", "kind = 'run_mean'\nat_most_mrad = 100\n",
        "kind = 'divergence'\nbeyond_mrad = 100\nat_most = 0\n"}) {
    const auto campaign = parse(two_variants + "[[metric]]\nquantity = 'attitude.heading'\n" + metric);
    ASSERT_TRUE(campaign) << campaign.error().message;
    for (const std::size_t updates : {10U, 30U}) {
      const auto evaluation = evaluate(*campaign, [&](std::size_t) -> Result<std::vector<RunSeries>> {
        std::vector<RunSeries> runs;
        for (std::uint64_t run = 0; run < 4; ++run) runs.push_back(run_with(run, std::vector(updates, 1e-3)));
        return runs;
      });
      ASSERT_TRUE(evaluation) << evaluation.error().message;
      EXPECT_EQ(evaluation->answers.at(0).passed, updates == 30) << metric;
    }
  }
}

}  // namespace
}  // namespace canhil::campaign
