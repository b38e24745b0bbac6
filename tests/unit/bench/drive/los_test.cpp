// An engagement from the text of a scenario to its checks, with the device in this process.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "bench/checks/judge.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/session.hpp"
#include "bench/estimators/end_of_flight.hpp"
#include "bench/estimators/los_rate/answers.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::drive {
namespace {

using checks::Outcome;
using testing::HasSubstr;

struct Flown {
  Collected run;
  checks::Verdict verdict;

  [[nodiscard]] const checks::CheckResult& check(std::string_view name) const {
    const auto found = std::ranges::find(verdict.checks, name, &checks::CheckResult::name);
    EXPECT_NE(found, verdict.checks.end()) << name;
    return *found;
  }
  [[nodiscard]] world::PlantRecords plants() const { return plants_of(run.per_run_truth); }
  [[nodiscard]] estimators::Passage passage() const { return estimators::Passage::find(plants()).value(); }
  /// The number of samples that the seeker took.
  [[nodiscard]] std::size_t samples() const { return plants()[0]->times_us().size() - 2; }  // start, passage
  [[nodiscard]] double rms(double least, double most) const {
    return estimators::los_rms(estimators::los_errors(run.seen.of<estimators::LosAnswers>(), plants()), least,
                               most)
        .value();
  }
  [[nodiscard]] double miss() const { return passage().miss_n.value().norm(); }
};

scenario::Setting set(std::string key, std::string value) {
  return {.key = std::move(key), .value = std::move(value), .elements = {}, .line = 1};
}

Result<scenario::Scenario> read(const std::string& name, const std::vector<scenario::Setting>& settings) {
  std::ifstream file(SOURCE_DIR "/bench/flights/" + name + ".toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return scenario::parse(text, name + ".toml", contract(), settings);
}

Flown fly(const std::string& name, const std::vector<scenario::Setting>& settings = {},
          std::uint64_t run_index = 0) {
  const auto scenario = read(name, settings);
  EXPECT_TRUE(scenario) << scenario.error().message;
  const auto truth = make_truth(*scenario);
  EXPECT_TRUE(truth) << truth.error().message;
  auto flown = run_in_process(*scenario, *truth, run_index);
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  checks::Verdict verdict =
      checks::judge(*scenario, {.seen = flown->seen,
                                .truth = truth_of(*truth, flown->per_run_truth, scenario->duration_us),
                                .estimators = estimators::all(),
                                .ended_early = flown->ending.detail,
                                .timing_unfit = "virtual time"});
  return {std::move(*flown), std::move(verdict)};
}

void expect_outputs_pass(const Flown& flown) {
  int passed = 0;
  for (const checks::CheckResult& check : flown.verdict.checks) {
    EXPECT_NE(check.outcome, Outcome::fail) << check.name << ": " << check.measured;
    passed += check.outcome == Outcome::pass ? 1 : 0;
  }
  EXPECT_GE(passed, 6);
}

TEST(Los, EveryAlgorithmSeesTheSameFlight) {
  const Flown combined = fly("los_quick");
  expect_outputs_pass(combined);
  EXPECT_EQ(combined.run.seen.of<estimators::LosAnswers>().size(), combined.samples());
  for (const char* algorithm : {"\"kalman\"", "\"switched_table\"", "\"low_pass\""}) {
    const Flown other = fly("los_quick", {set("target.algorithm", algorithm)});
    EXPECT_EQ(other.miss(), combined.miss()) << "guidance is on the truth";
    EXPECT_NE(other.rms(1, 2), combined.rms(1, 2));
    EXPECT_LT(other.rms(1, 2), 3e-3) << algorithm;
  }
}

TEST(Los, WithoutNoiseTheErrorIsThatOfTheBus) {
  // A filter designed for noise lags behind a manoeuvre. A filter designed without noise has no lag, so only
  // the rounding on the bus remains as error.
  const Flown quiet =
      fly("los_quick", {set("seeker.thermal_noise_radpm2", "0"), set("seeker.glint_noise_m", "0"),
                        set("seeker.gyro_noise_mradps", "0"), set("seeker.gyro_bias_sigma_mradps", "0"),
                        set("seeker.accel_noise_mps2", "0"), set("seeker.accel_bias_sigma_mps2", "0"),
                        set("seeker.range_noise_m", "0"), set("seeker.range_bias_sigma_m", "0"),
                        set("seeker.closing_speed_noise_mps", "0"),
                        set("seeker.closing_speed_bias_sigma_mps", "0"), set("engagement.manoeuvre_g", "0")});
  EXPECT_LT(quiet.rms(0.2, 2), 1e-4);
}

TEST(Los, TheLoopIsClosedOverTheBus) {
  const Flown closed = fly("los_closed_loop");
  expect_outputs_pass(closed);
  EXPECT_EQ(closed.passage().late_commands, 0U) << "in lockstep every answer is in time";
  const Flown other = fly("los_closed_loop", {set("target.algorithm", "\"kalman\"")});
  EXPECT_NE(closed.miss(), other.miss()) << "each flies its own estimate";
  const Flown slow = fly("los_closed_loop", {set("seeker.latency_ms", "300")});
  EXPECT_GT(slow.miss(), 2) << "a late loop misses";
  expect_outputs_pass(fly("los_closed_loop_500hz"));
}

TEST(Los, LostSamplesAreBridgedAndSoIsABlackout) {
  const Flown lossy = fly("los_quick", {set("seeker.loss_percent", "5")});
  EXPECT_LT(lossy.rms(1, 2), 6e-3);
  EXPECT_LT(lossy.run.seen.of<estimators::LosAnswers>().size(), lossy.samples());
  const Flown black = fly("los_quick", {set("seeker.blackout_s", "[3.0, 3.2]")});
  EXPECT_EQ(black.check("answers coasting").outcome, Outcome::fail);
  EXPECT_EQ(black.check("answers coasting").measured, "coasting 41");
  EXPECT_EQ(black.check("error los.rate rms 0.5 to 0.2 s to go").outcome, Outcome::pass);
}

TEST(Los, WhatTheBusOrTheLockstepCannotCarryIsRefused) {
  const auto error_of = [](const std::vector<scenario::Setting>& settings) {
    const auto scenario = read("los_closed_loop", settings);
    EXPECT_TRUE(scenario) << scenario.error().message;
    const auto truth = make_truth(*scenario);
    return truth ? std::string("no error") : truth.error().message;
  };
  EXPECT_THAT(error_of({set("seeker.period_ms", "50")}),
              HasSubstr("seeker interval 50000 us does not fit into SeekerAngles.interval_us"));
  EXPECT_THAT(error_of({set("engagement.roll_rate_radps", "20")}),
              HasSubstr("roll increment 0.1 rad does not fit into SeekerAntenna.antenna_increment_roll_rad"));
  EXPECT_THAT(error_of({set("engagement.guidance_delay_ms", "5")}),
              HasSubstr("key 'engagement.guidance_delay_ms': 5 is less than the bus takes in lockstep, "
                        "expected at least 10"));
  EXPECT_EQ(error_of({}), "no error");
}

}  // namespace
}  // namespace canhil::drive
