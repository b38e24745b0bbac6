// The glider from the text of a scenario to its checks, with the device in this process.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/estimators/wind/answers.hpp"

namespace canhil::drive {
namespace {

using messages::WindOutcome;
using testing::HasSubstr;

scenario::Scenario quick(const std::vector<scenario::Setting>& settings) {
  std::ifstream file(SOURCE_DIR "/bench/flights/wind_quick.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const auto scenario = scenario::parse(text, "quick.toml", contract(), settings);
  EXPECT_TRUE(scenario) << scenario.error().message;
  return *scenario;
}

scenario::Setting set(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value), .elements = {}, .line = 1};
}

estimators::TrueAir air_of(const PerRunTruth& own) {
  return estimators::TrueAir::find(plants_of(own), estimators::true_air).value();
}

struct Flown {
  checks::Observations seen;
  PerRunTruth per_run_truth;
  checks::Verdict verdict;

  [[nodiscard]] std::int64_t count(WindOutcome outcome) const {
    return std::ranges::count(seen.of<estimators::WindAnswers>(), outcome, &estimators::WindAnswer::outcome);
  }
  [[nodiscard]] std::int64_t flagged(bool estimators::WindAnswer::*flag) const {
    return std::ranges::count(seen.of<estimators::WindAnswers>(), true, flag);
  }
  [[nodiscard]] double mean_error(double (*component)(const estimators::WindError&)) const {
    double sum = 0;
    std::size_t count = 0;
    for (const estimators::WindError& error :
         estimators::wind_errors(seen.of<estimators::WindAnswers>(), air_of(per_run_truth))) {
      if (error.t_us < 10'000'000) continue;
      sum += std::abs(component(error));
      ++count;
    }
    return sum / static_cast<double>(count);
  }
};

double norm(const estimators::WindError& error) { return error.error_n.norm(); }
double along_track(const estimators::WindError& error) { return error.along_track; }
double cross_track(const estimators::WindError& error) { return error.cross_track; }

Flown fly(const std::vector<scenario::Setting>& settings = {}, std::uint64_t run = 0) {
  const scenario::Scenario scenario = quick(settings);
  const auto truth = make_truth(scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto flown = run_in_process(scenario, *truth, run);
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  checks::Verdict verdict =
      checks::judge(scenario, {.seen = flown->seen,
                               .truth = truth_of(*truth, flown->per_run_truth, scenario.duration_us),
                               .estimators = estimators::all(),
                               .ended_early = flown->ending.detail,
                               .timing_unfit = "virtual time"});
  return {std::move(flown->seen), std::move(flown->per_run_truth), std::move(verdict)};
}

TEST(Wind, IsEstimatedThroughTheBus) {
  const Flown flown = fly();
  for (const checks::CheckResult& check : flown.verdict.checks)
    EXPECT_NE(check.outcome, checks::Outcome::fail) << check.name << ": " << check.measured;
  EXPECT_GE(flown.count(WindOutcome::updated), 990);
  EXPECT_LT(flown.mean_error(norm), 2);
}

// The first answer contains exactly the initial state from the carrier. All other errors are set to 0,
// because with navigation noise and coefficient errors of 20 %, the error would be 1.2 m/s RMS even if the
// carrier sent the true wind.
TEST(Wind, StartsFromWhatTheCarrierReports) {
  const auto first_error = [](const std::string& sigma) {
    std::vector<scenario::Setting> settings{set("glide.initial_error.air_velocity_sigma_mps", sigma)};
    for (const char* quiet :
         {"glide.initial_error.attitude_sigma_deg", "glide.initial_error.rate_sigma_degps",
          "airframe.coefficient_error_percent", "glider_nav.velocity_noise_mps",
          "glider_nav.attitude_noise_deg", "glider_nav.rate_noise_degps"})
      settings.push_back(set(quiet, "0"));
    const Flown flown = fly(settings);
    return estimators::wind_errors(flown.seen.of<estimators::WindAnswers>(), air_of(flown.per_run_truth))
        .front()
        .error_n.norm();
  };
  EXPECT_LT(first_error("0"), 0.1);
  EXPECT_GT(first_error("10"), 1);
}

TEST(Wind, DenserAirIsAWindAlongTheTrack) {
  const Flown flown =
      fly({set("airframe.density_error_percent", "3"), set("airframe.coefficient_error_percent", "0")});
  // The density error causes an error of 1.5 % of the air speed. Over 40 runs, the mean wind error along the
  // track was 2.73 m/s with a sigma of 0.09 m/s; across the track, the error was at most 0.24 m/s.
  EXPECT_NEAR(flown.mean_error(along_track), 2.73, 0.35);
  EXPECT_LT(flown.mean_error(cross_track), 0.35);
}

TEST(Wind, FinsThatStayAwayAreReported) {
  const Flown lost = fly({set("fins.outage_s", "1"), set("fins.outage_every_s", "5")});
  EXPECT_GT(lost.flagged(&estimators::WindAnswer::fins_missing), 4 * 40);
  EXPECT_EQ(fly().flagged(&estimators::WindAnswer::fins_missing), 0);
  EXPECT_GT(fly({set("fins.latency_ms", "50")}).flagged(&estimators::WindAnswer::fins_late), 900);
}

TEST(Wind, NavigationThatStaysAwayIsBridged) {
  const Flown flown = fly({set("glider_nav.outage_s", "1"), set("glider_nav.outage_every_s", "5")});
  EXPECT_NEAR(static_cast<double>(flown.count(WindOutcome::updated)), 800, 10);
  EXPECT_LT(flown.mean_error(norm), 3);
}

TEST(Wind, AGlideThatEndsBeforeTheRunIsRefused) {
  const scenario::Scenario low = quick({set("glide.height_m", "100"), set("glide.speed_mps", "80")});
  const auto own = make_flight(low, *make_truth(low), 7);
  ASSERT_FALSE(own);
  EXPECT_THAT(own.error().message, HasSubstr("key 'duration_s': run 7: the glide ends at t="));
}

TEST(Wind, RunsAreDrawnApartAndAgain) {
  const Flown a = fly({}, 3);
  const Flown b = fly({}, 3);
  const Flown c = fly({}, 4);
  EXPECT_EQ(a.seen.of<estimators::WindAnswers>().back().wind_n,
            b.seen.of<estimators::WindAnswers>().back().wind_n);
  EXPECT_NE(a.seen.of<estimators::WindAnswers>().back().wind_n,
            c.seen.of<estimators::WindAnswers>().back().wind_n);
  EXPECT_NE(air_of(a.per_run_truth).at(20'000'000), air_of(c.per_run_truth).at(20'000'000));
}

}  // namespace
}  // namespace canhil::drive
