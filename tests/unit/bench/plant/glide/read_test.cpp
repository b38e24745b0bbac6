// The sections of a glider: their values in SI units, and one line per error.
#include <gtest/gtest.h>

#include "bench/bindings/canhil.hpp"
#include "bench/checks/kinds/answers.hpp"
#include "bench/checks/kinds/consistency.hpp"
#include "bench/checks/kinds/error.hpp"
#include "bench/plant/glide/glide.hpp"
#include "bench/plant/registry.hpp"
#include "bench/plant/setup.hpp"
#include "bench/quantities/quantity.hpp"
#include "bench/sensors/fins.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/world/truth_values.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using plant::glide::ErrorKind;
using plant::glide::Settings;
using world::units::deg;

const DbcVocabulary glider_contract{.estimators = {"transfer_alignment", "wind"},
                                    .algorithms = {"ekf", "h_infinity"},
                                    .parameters = {"theta_per_s"},
                                    .messages = {"WindVector"},
                                    .answers = {"WindVector"},
                                    .check_kinds = checks::kinds(estimators::all()),
                                    .known = estimators::all(),
                                    .facts = estimators::bound_to({}, bindings::canhil()).facts,
                                    .nodes = nodes::tables(),
                                    .binding = bindings::canhil(),
                                    .plants = plant::tables()};

constexpr std::string_view glider = R"(title = "A glider"
duration_s = 20.0
seed = 7
[target]
estimator = "wind"
algorithm = "ekf"
initial_sigma = { velocity_mps = 1.0, tilt_deg = 2.0, heading_deg = 5.0, position_m = 10.0 }
[glide]
heading_deg = 90
speed_mps = 250
height_m = 10000
[wind]
season = "june"
[fins]
[glider_nav]
[[check]]
kind = "heartbeat"
silent_at_most_s = 0.5
)";

Result<Scenario> read(std::string_view text) { return parse(text, "g.toml", glider_contract); }
const Settings& settings_of(const Scenario& scenario) {
  return dynamic_cast<const plant::glide::GliderPlan&>(*scenario.of_tables.at(0).setup->plan).settings();
}
Scenario glides(std::string_view text) {
  const auto scenario = read(text);
  if (scenario) return *scenario;
  ADD_FAILURE() << scenario.error().message;
  return {};
}
std::string complaint(std::string_view from, std::string_view to) {
  const auto scenario = read(with(from, to, glider));
  return scenario ? "no error" : scenario.error().message;
}

TEST(GlideSections, WhatTheWindFilterIsConfiguredWithIsWrongByTheGlide) {
  EXPECT_EQ(complaint("[glide]", "[target.initial_error]\nattitude_sigma_deg = 1\n[glide]"),
            "g.toml:8: key 'target.initial_error': has no effect on 'wind', expected [glide.initial_error]");
  EXPECT_EQ(complaint("[wind]", "[glide.initial_error]\nattitude_sigma_deg = 1\n[wind]"), "no error");
}

TEST(GlideSections, NeedNoTruthOfNavigation) {
  const Scenario s = glides(glider);
  ASSERT_EQ(s.of_tables.size(), 1U);
  const Settings& settings = settings_of(s);
  EXPECT_NEAR(settings.heading, 90 * deg, 1e-15);
  EXPECT_EQ(settings.speed, 250);
  EXPECT_EQ(settings.height, 10'000);
  EXPECT_LT(
      (settings.wind.at(11'000) - plant::glide::WindProfile(plant::glide::Season::june).at(11'000)).norm(),
      1e-12);
  EXPECT_EQ(settings.coefficients.level, 0);
  EXPECT_EQ(settings.density_error, 0);
  EXPECT_EQ(s.of_tables.front().release.air_velocity, 0);
  EXPECT_FALSE(node_of<sensors::FinsSettings>(s).schedule.period_us);
  EXPECT_TRUE(std::holds_alternative<world::Rest>(s.truth.motion));
}

TEST(GlideSections, CarryEveryKey) {
  std::string text =
      with("season = \"june\"", "steady_mps = [1, -20, 0.5]\ngust_sigma_mps = 1.5\ngust_time_s = 2", glider);
  text = with(
      "[wind]",
      "[glide.initial_error]\nair_velocity_sigma_mps = 1\nvelocity_sigma_mps = 0.5\nattitude_sigma_deg = "
      "0.1\nrate_sigma_degps = 0.01\n[airframe]\ncoefficient_error_percent = 20\ncoefficient_error = "
      "\"markov\"\nmarkov_time_s = 2\nper = \"total\"\nof = \"forces\"\ndensity_error_percent = -3\n[wind]",
      text);
  text = with("[fins]",
              "[fins]\nperiod_ms = 20\nlatency_ms = 50\ntime_stamp_error_ms = 40\nloss_percent = 10", text);
  text = with("[glider_nav]",
              "[glider_nav]\nperiod_ms = 50\nvelocity_noise_mps = 0.25\nrate_noise_degps = "
              "0.125\nattitude_noise_deg = "
              "0.25\ncorrelated_fraction = 0.5\ncorrelation_time_s = 30\noutage_s = 1\noutage_every_s = 10",
              text);
  const Scenario s = glides(text);
  const Settings& plan = settings_of(s);
  EXPECT_EQ(plan.wind.at(3000), world::Vector3(1, -20, 0.5));
  EXPECT_EQ(plan.gusts.sigma, 1.5);
  EXPECT_EQ(plan.gusts.time, 2);
  EXPECT_NEAR(plan.coefficients.level, 0.2, 1e-15);
  EXPECT_EQ(plan.coefficients.kind, ErrorKind::markov);
  EXPECT_EQ(plan.coefficients.time_us, 2'000'000);
  EXPECT_FALSE(plan.coefficients.per_part);
  EXPECT_FALSE(plan.coefficients.moments);
  EXPECT_NEAR(plan.density_error, -0.03, 1e-15);
  EXPECT_EQ(s.of_tables.front().release.air_velocity, 1);
  EXPECT_EQ(s.of_tables.front().release.velocity, 0.5);
  EXPECT_NEAR(s.of_tables.front().release.attitude, 0.1 * deg, 1e-15);
  EXPECT_NEAR(s.of_tables.front().release.rate, 0.01 * deg, 1e-15);
  const auto fins = node_of<sensors::FinsSettings>(s);
  EXPECT_EQ(fins.schedule.period_us, 20'000);
  EXPECT_EQ(fins.schedule.latency_us, 50'000);
  EXPECT_EQ(fins.stamp_error_us, 40'000);
  EXPECT_NEAR(fins.loss.probability, 0.1, 1e-15);
  const auto navigation = node_of<sensors::GliderNavSettings>(s);
  EXPECT_EQ(navigation.schedule.period_us, 50'000);
  EXPECT_EQ(navigation.velocity_noise, 0.25);
  EXPECT_NEAR(navigation.rate_noise, 0.125 * deg, 1e-15);
  EXPECT_NEAR(navigation.attitude_noise, 0.25 * deg, 1e-15);
  EXPECT_EQ(navigation.correlated_fraction, 0.5);
  EXPECT_EQ(navigation.correlation_time, 30);
  EXPECT_EQ(navigation.loss.outage_us, 1'000'000);
  EXPECT_EQ(navigation.loss.outage_every_us, 10'000'000);
}

TEST(GlideSections, ChecksOfTheWind) {
  const Scenario s =
      glides(with("[[check]]",
                  "[[check]]\nkind = 'error'\nquantity = 'wind.along'\nstatistic = 'mean'\n"
                  "from_s = 10\nbelow_mps = 2\n[[check]]\nkind = 'answers'\nupdated_at_least = 5\n"
                  "fins_late_at_most = 1\n[[check]]\nkind = 'consistency'\nquantity = 'wind.nis'\n"
                  "probability = 0.99\n[[check]]",
                  glider));
  const auto error = rule_of<checks::Error>(s.checks.at(0));
  EXPECT_EQ(s.checks.at(0).name, "error wind.along mean");
  EXPECT_EQ(error.judged.estimator, "wind");
  EXPECT_EQ(error.judged.quantity->name, "wind.along");
  EXPECT_EQ(error.statistic, checks::Error::Statistic::mean);
  EXPECT_EQ(error.stretch.window.from_us, 10'000'000);
  EXPECT_EQ(error.below, 2);
  const auto answers = rule_of<checks::Answers>(s.checks.at(1));
  ASSERT_EQ(answers.counts.size(), 2U);
  EXPECT_EQ(answers.counts[0].mark, "updated");
  EXPECT_EQ(answers.counts[0].at_least, 5);
  EXPECT_EQ(answers.counts[1].mark, "fins_late");
  EXPECT_EQ(rule_of<checks::Consistency>(s.checks.at(2)).judged.quantity->degrees_of_freedom, 9);
}

TEST(GlideSections, ItsOutputsCanBeJudgedByName) {
  const Scenario s =
      glides(with("[[check]]",
                  "[[check]]\nkind = 'response'\nquantity = 'plant.height'\nstatistic = 'steady_error'\n"
                  "setpoint_m = 9900\nbelow_m = 200\n[[check]]",
                  glider));
  EXPECT_EQ(s.checks.at(0).name, "response steady_error of plant.height");
  EXPECT_EQ(s.plant_with("wind.down"), &s.of_tables.front());
  EXPECT_EQ(s.plant_with("plant.rudder"), nullptr);
  EXPECT_EQ(why_no_truth(s, *world::find_truth_value("wind.down")), "");
  EXPECT_EQ(why_no_truth(s, *world::find_truth_value("plant.height")), "");
  const Scenario none;
  EXPECT_EQ(why_no_truth(none, *world::find_truth_value("wind.down")),
            "no truth of wind.down: no plant of the scenario has it");
}

TEST(GlideSections, WrongOnesGiveOneLine) {
  EXPECT_EQ(complaint("[wind]\nseason = \"june\"\n", ""),
            "g.toml:1: key 'wind': is missing, expected a table");
  EXPECT_EQ(complaint("[fins]\n", ""), "g.toml:1: key 'fins': is missing, expected a table");
  EXPECT_EQ(complaint("[glider_nav]\n", ""), "g.toml:1: key 'glider_nav': is missing, expected a table");
  EXPECT_EQ(complaint("\"june\"", "\"july\""),
            "g.toml:13: key 'wind.season': 'july' is unknown, expected 'june'");
  EXPECT_EQ(complaint("season = \"june\"", "season = \"june\"\nsteady_mps = 3"),
            "g.toml:14: key 'wind.steady_mps': is given beside season, expected one of the two");
  EXPECT_EQ(complaint("speed_mps = 250", "speed_mps = 400"),
            "g.toml:10: key 'glide.speed_mps': 400 is out of range, expected a number from 80 to 300");
  EXPECT_EQ(
      complaint("[fins]", "[fins]\nperiod_ms = 15"),
      "g.toml:15: key 'fins.period_ms': is not a multiple of the truth's step, expected a multiple of 10");
  EXPECT_EQ(
      complaint("[fins]", "[fins]\noutage_s = 1"),
      "g.toml:15: key 'fins.outage_s': is given alone, expected outage_s and outage_every_s, both above 0");
  EXPECT_EQ(complaint("[fins]", "[fins]\noutage_s = 3\noutage_every_s = 2"),
            "g.toml:15: key 'fins.outage_s': is longer than outage_every_s, expected a shorter outage");
  EXPECT_EQ(
      complaint("[glider_nav]", "[glider_nav]\ncorrelated_fraction = 1.5"),
      "g.toml:16: key 'glider_nav.correlated_fraction': 1.5 is out of range, expected a number from 0 to 1");
  EXPECT_EQ(complaint("[wind]", "[wind]\ngust_time_s = 3"),
            "g.toml:13: key 'wind.gust_time_s': has no effect alone, expected gust_sigma_mps beside it");
  for (const std::string kind : {"", "coefficient_error = \"constant\"\n"}) {
    EXPECT_EQ(
        complaint("[fins]", "[airframe]\n" + kind + "markov_time_s = 3\n[fins]"),
        std::string("g.toml:") + (kind.empty() ? "15" : "16") +
            ": key 'airframe.markov_time_s': has no effect here, expected coefficient_error = \"markov\" "
            "beside it");
  }
  EXPECT_EQ(
      complaint("[[check]]", "[[check]]\nkind = \"answers\"\n[[check]]"),
      "g.toml:16: key 'check[1].answers_at_least': is missing, as are all other limits, expected at least "
      "one limit");
}

}  // namespace
}  // namespace canhil::scenario
