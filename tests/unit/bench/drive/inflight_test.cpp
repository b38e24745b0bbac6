// In-flight alignment from the text of a scenario to its checks, with the device in this process.
// Tests the nodes, the faults, and the responses of the target.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::drive {
namespace {

using messages::FixOutcome;

struct Flown {
  scenario::Scenario scenario;
  checks::Observations seen;
  checks::Verdict verdict;

  [[nodiscard]] checks::Outcome outcome(std::string_view check) const {
    const auto found = std::ranges::find(verdict.checks, check, &checks::CheckResult::name);
    EXPECT_NE(found, verdict.checks.end()) << check;
    return found->outcome;
  }
  [[nodiscard]] std::int64_t count(FixOutcome outcome) const {
    return std::ranges::count(seen.of<estimators::InflightAnswers>().fixes, outcome,
                              &estimators::FixAnswer::outcome);
  }
};

Flown fly(const std::vector<scenario::Setting>& settings = {}) {
  std::ifstream file(SOURCE_DIR "/bench/flights/inflight_quick.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const auto scenario = scenario::parse(text, "quick.toml", contract(), settings);
  EXPECT_TRUE(scenario) << scenario.error().message;
  const auto truth = make_truth(*scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto flown = run_in_process(*scenario, *truth, 0);
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  checks::Verdict verdict =
      checks::judge(*scenario, {.seen = flown->seen,
                                .truth = truth_of(*truth, flown->per_run_truth, scenario->duration_us),
                                .estimators = estimators::all(),
                                .ended_early = flown->ending.detail,
                                .timing_unfit = "virtual time"});
  return {*scenario, std::move(flown->seen), std::move(verdict)};
}

scenario::Setting set(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value), .elements = {}, .line = 1};
}

void expect_aligned(const Flown& flown) {
  EXPECT_EQ(flown.outcome("error attitude.heading"), checks::Outcome::pass);
  EXPECT_EQ(flown.outcome("error position.norm"), checks::Outcome::pass);
}

TEST(InFlight, AlignsFromNinetyDegreesOff) {
  const Flown flown = fly();
  expect_aligned(flown);
  EXPECT_EQ(flown.outcome("consistency innovation.nis"), checks::Outcome::pass);
  EXPECT_EQ(flown.outcome("counters"), checks::Outcome::pass);
  EXPECT_EQ(flown.count(FixOutcome::accepted), 29) << "of the 30, the last one would arrive after the end";
  EXPECT_EQ(std::ranges::count(flown.seen.of<estimators::InflightAnswers>().navigation, true,
                               &estimators::NavigationAnswer::coasting),
            0);
}

// On the S path the vehicle moves about 60 m east within 30 s. If it starts just west of 180 deg, it crosses
// the date line in the first seconds.
TEST(InFlight, GoesOnAcrossTheDateLineAsAnywhereElse) {
  for (const std::string aiding : {"0", "1"}) {  // ssbl, gps
    const auto at = [&](const std::string& longitude_deg) {
      return fly({set("gps.noise_m", "2"), set("target.parameters.aiding", aiding),
                  set("truth.longitude_deg", longitude_deg)});
    };
    const Flown here = at("129.0"), across = at("179.9999");
    EXPECT_EQ(across.count(FixOutcome::invalid), 0) << aiding;
    EXPECT_EQ(across.count(FixOutcome::accepted), here.count(FixOutcome::accepted)) << aiding;
    EXPECT_EQ(across.outcome("error position.norm"), checks::Outcome::pass) << aiding;
    EXPECT_LT(across.seen.of<estimators::InflightAnswers>().fixes.back().position.longitude, 0) << aiding;
    EXPECT_NEAR(across.seen.of<estimators::InflightAnswers>().fixes.back().nis,
                here.seen.of<estimators::InflightAnswers>().fixes.back().nis, 0.1)
        << aiding;
  }
}

TEST(InFlight, OutliersOfAKilometreAreGatedAndDoNoHarm) {
  const Flown flown = fly({set("ssbl.outlier_percent", "15"), set("ssbl.outlier_m", "1000"),
                           set("target.parameters.gate_nis", "30"), set("seed", "3")});
  expect_aligned(flown);
  EXPECT_GT(flown.count(FixOutcome::gated), 0);
  EXPECT_EQ(flown.count(FixOutcome::accepted) + flown.count(FixOutcome::gated), 29);
}

TEST(InFlight, FixesOfTheOtherSourceAreRefusedWithTheReason) {
  const Flown flown = fly({set("gps.noise_m", "10")});
  expect_aligned(flown);
  EXPECT_EQ(flown.count(FixOutcome::wrong_source), 30);
  for (const estimators::FixAnswer& fix : flown.seen.of<estimators::InflightAnswers>().fixes)
    EXPECT_EQ(fix.outcome == FixOutcome::wrong_source, fix.source == messages::FixSource::gps);
}

TEST(InFlight, InvalidFixesAreRefusedWithTheReason) {
  const Flown flown = fly({set("ssbl.invalid_percent", "30")});
  EXPECT_GT(flown.count(FixOutcome::invalid), 0);
  EXPECT_EQ(flown.count(FixOutcome::accepted) + flown.count(FixOutcome::invalid), 29);
  expect_aligned(flown);
}

TEST(InFlight, LostImuGroupsAreBridgedAndFlagged) {
  const Flown flown = fly({set("slave_imu.loss_percent", "5")});
  const auto lost = 1500 - static_cast<std::int64_t>(flown.seen.stimuli.at("SlaveImu").count);
  EXPECT_NEAR(static_cast<double>(lost), 75, 5 * 8.5);
  const auto flagged = std::ranges::count(flown.seen.of<estimators::InflightAnswers>().navigation, true,
                                          &estimators::NavigationAnswer::coasting);
  EXPECT_LE(flagged, lost) << "two in a row are bridged by one answer";
  EXPECT_GE(flagged, lost * 8 / 10);
  expect_aligned(flown);
}

TEST(InFlight, LostFixesNeedNoAnswer) {
  const Flown flown = fly({set("ssbl.loss_percent", "20")});
  const auto& fixes = flown.seen.of<estimators::InflightAnswers>().fixes;
  const auto predicted = std::ranges::count(fixes, FixOutcome::predicted, &estimators::FixAnswer::outcome);
  EXPECT_EQ(fixes.size() - static_cast<std::size_t>(predicted), flown.seen.stimuli.at("Ssbl").count);
  EXPECT_LT(flown.seen.stimuli.at("Ssbl").count, 29U);
  expect_aligned(flown);
}

// Without a fix for more than 2 s the target answers with predictions, whose sigmas grow.
TEST(InFlight, AnOutageIsAnsweredWithPredictionsThatBecomeWorse) {
  const Flown flown = fly({set("ssbl.silence_s", "[20.0, 28.0]")});
  double before = 0;
  int predicted = 0;
  for (const estimators::FixAnswer& fix : flown.seen.of<estimators::InflightAnswers>().fixes) {
    if (fix.outcome != FixOutcome::predicted) continue;
    ++predicted;
    EXPECT_EQ(fix.source, messages::FixSource::imu);
    EXPECT_GE(fix.position_sigma.x(), before);
    before = fix.position_sigma.x();
  }
  EXPECT_GT(predicted, 20) << "at the output's rate";
}

TEST(InFlight, TwoSecondsOfLatencyDoNoHarmAtTheTimeOfValidity) {
  const Flown flown = fly({set("ssbl.latency_ms", "2000")});
  expect_aligned(flown);
  EXPECT_EQ(flown.count(FixOutcome::accepted), 28);
}

}  // namespace
}  // namespace canhil::drive
