// [engagement] and [seeker]: values, defaults, and errors.
#include <gtest/gtest.h>

#include "bench/checks/kinds/error.hpp"
#include "bench/estimators/los_rate/miss_distance.hpp"
#include "bench/plant/engagement/plan.hpp"
#include "bench/plant/setup.hpp"
#include "bench/quantities/quantity.hpp"
#include "bench/sensors/seeker.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::plant::engagement {
namespace {

using namespace scenario;
using world::units::deg;
using world::units::mrad;

constexpr std::string_view los = R"(title = "A title"
duration_s = 6.0
seed = 7
[target]
estimator = "los_rate"
algorithm = "kalman"
[engagement]
guidance = "truth"
[seeker]
[[check]]
kind = "miss_distance"
below_m = 1.0
)";

std::string los_with(std::string_view section, std::string_view lines) {
  return with(section, std::string(section) + "\n" + std::string(lines), los);
}

const Settings& settings_of(const Scenario& scenario) {
  return dynamic_cast<const MissilePlan&>(*scenario.of_tables.at(0).setup->plan).settings();
}

TEST(EngagementFields, DefaultsAreThoseOfTheWorld) {
  const Scenario s = parsed(los);
  const Settings plan = settings_of(s), standard;
  EXPECT_EQ(plan.range, standard.range);
  EXPECT_EQ(plan.missile_speed, standard.missile_speed);
  EXPECT_EQ(plan.target_speed, standard.target_speed);
  EXPECT_DOUBLE_EQ(plan.heading_error_sigma, standard.heading_error_sigma);
  EXPECT_DOUBLE_EQ(plan.pointing_error_sigma, standard.pointing_error_sigma);
  EXPECT_DOUBLE_EQ(plan.acceleration_limit, standard.acceleration_limit);
  EXPECT_EQ(plan.autopilot_lag, standard.autopilot_lag);
  EXPECT_EQ(plan.servo_gain, standard.servo_gain);
  EXPECT_EQ(plan.manoeuvre.kind, standard.manoeuvre.kind);
  EXPECT_DOUBLE_EQ(plan.manoeuvre.acceleration, standard.manoeuvre.acceleration);
  EXPECT_EQ(plan.manoeuvre.at_time_to_go, standard.manoeuvre.at_time_to_go);
  EXPECT_EQ(plan.guidance, Guidance::truth);
  EXPECT_EQ(plan.guidance_delay_us, standard.guidance_delay_us);
  EXPECT_FALSE(plan.guidance_predicts);
  EXPECT_FALSE(s.of_tables[0].guidance.has_value());
  EXPECT_FALSE(s.closes_the_loop());
  const auto seeker = node_of<sensors::SeekerSettings>(s), usual = sensors::SeekerSettings{};
  EXPECT_EQ(seeker.errors.thermal, usual.errors.thermal);
  EXPECT_EQ(seeker.errors.glint, usual.errors.glint);
  EXPECT_DOUBLE_EQ(seeker.errors.gyro_noise, usual.errors.gyro_noise);
  EXPECT_DOUBLE_EQ(seeker.errors.gyro_bias.sigma, usual.errors.gyro_bias.sigma);
  EXPECT_EQ(seeker.errors.range_bias.sigma, usual.errors.range_bias.sigma);
  EXPECT_DOUBLE_EQ(seeker.errors.field_of_view, usual.errors.field_of_view);
  EXPECT_EQ(seeker.jitter_us, 0);
  EXPECT_FALSE(seeker.blackout_us.has_value());
  const auto& rest = std::get<world::Rest>(s.truth.motion);
  EXPECT_EQ(rest.angles.heading, 0) << "nothing navigates";
}

TEST(EngagementFields, EveryKey) {
  const Scenario s =
      parsed(with("guidance = \"truth\"",
                  "guidance = \"target\"\nguidance_delay_ms = 20\nguidance_predicts = true\nrange_m = "
                  "4000\nmissile_speed_mps = 700\n"
                  "target_speed_mps = 200\nheading_error_deg = 2\nheading_error_sigma_deg = 1\n"
                  "pointing_error_sigma_mrad = 3\nplanes = \"yaw\"\nmanoeuvre = \"weave\"\nmanoeuvre_g = 5\n"
                  "manoeuvre_period_s = 1.5\nmanoeuvre_from_s = 0.5\nnavigation_constant = 3\n"
                  "autopilot_lag_s = 0.2\nacceleration_limit_g = 20\nantenna_servo_per_s = 15\n"
                  "roll_rate_radps = 3",
                  los));
  const Settings plan = settings_of(s);
  ASSERT_TRUE(s.of_tables[0].guidance.has_value());
  EXPECT_EQ(s.of_tables[0].guidance->delay_us, 20'000);
  EXPECT_TRUE(s.of_tables[0].guidance->predicts);
  EXPECT_TRUE(s.closes_the_loop());
  EXPECT_DOUBLE_EQ(s.of_tables[0].to_go_s, 4000.0 / 900);
  EXPECT_EQ(s.of_tables[0].largest_roll_rate, 3);
  EXPECT_EQ(plan.guidance, Guidance::target);
  EXPECT_EQ(plan.guidance_delay_us, 20'000);
  EXPECT_TRUE(plan.guidance_predicts);
  EXPECT_EQ(plan.range, 4000);
  EXPECT_EQ(plan.missile_speed, 700);
  EXPECT_EQ(plan.target_speed, 200);
  EXPECT_DOUBLE_EQ(plan.heading_error, 2 * deg);
  EXPECT_DOUBLE_EQ(plan.heading_error_sigma, 1 * deg);
  EXPECT_DOUBLE_EQ(plan.pointing_error_sigma, 3 * mrad);
  EXPECT_EQ(plan.planes, ActivePlanes::yaw);
  EXPECT_EQ(plan.manoeuvre.kind, Manoeuvre::Kind::weave);
  EXPECT_DOUBLE_EQ(plan.manoeuvre.acceleration, 5 * 9.80665);
  EXPECT_EQ(plan.manoeuvre.period, 1.5);
  EXPECT_EQ(plan.manoeuvre.from_s, 0.5);
  EXPECT_FALSE(plan.manoeuvre.at_time_to_go.has_value());
  EXPECT_EQ(plan.navigation_constant, 3);
  EXPECT_EQ(plan.autopilot_lag, 0.2);
  EXPECT_DOUBLE_EQ(plan.acceleration_limit, 20 * 9.80665);
  EXPECT_EQ(plan.servo_gain, 15);
  EXPECT_EQ(plan.roll_rate, 3);
  EXPECT_EQ(settings_of(parsed(los_with("[engagement]", "manoeuvre = \"none\""))).manoeuvre.kind,
            Manoeuvre::Kind::none);
  EXPECT_EQ(
      settings_of(parsed(los_with("[engagement]", "manoeuvre_at_to_go_s = 2.5"))).manoeuvre.at_time_to_go,
      2.5);
}

TEST(SeekerFields, EveryKey) {
  const auto seeker = node_of<sensors::SeekerSettings>(
      parsed(los_with("[seeker]",
                      "period_ms = 2\nlatency_ms = 1.5\njitter_ms = 0.5\nthermal_noise_radpm2 = 2e-10\n"
                      "glint_noise_m = 0.7\nglint_correlation_ms = 40\nconstant_noise_mrad = 1\n"
                      "gyro_noise_mradps = 2\ngyro_bias_mradps = 3\ngyro_bias_sigma_mradps = 4\n"
                      "accel_noise_mps2 = 5\naccel_bias_mps2 = 6\naccel_bias_sigma_mps2 = 7\n"
                      "range_noise_m = 8\nrange_bias_m = -9\nrange_bias_sigma_m = 10\n"
                      "range_errors_full_beyond_m = 500\nclosing_speed_noise_mps = 11\n"
                      "closing_speed_bias_mps = -12\nclosing_speed_bias_sigma_mps = 13\n"
                      "field_of_view_deg = 5\nloss_percent = 1\ninvalid_percent = 2\n"
                      "invalid_range_percent = 3\nblackout_s = [1, 1.5]")));
  EXPECT_EQ(seeker.schedule.period_us, 2000);
  EXPECT_EQ(seeker.schedule.latency_us, 1500);
  EXPECT_EQ(seeker.jitter_us, 500);
  EXPECT_EQ(seeker.errors.thermal, 2e-10);
  EXPECT_EQ(seeker.errors.glint, 0.7);
  EXPECT_DOUBLE_EQ(seeker.errors.glint_correlation, 0.04);
  EXPECT_DOUBLE_EQ(seeker.errors.constant, 1e-3);
  EXPECT_DOUBLE_EQ(seeker.errors.gyro_noise, 2e-3);
  EXPECT_DOUBLE_EQ(seeker.errors.gyro_bias.value, 3e-3);
  EXPECT_DOUBLE_EQ(seeker.errors.gyro_bias.sigma, 4e-3);
  EXPECT_EQ(seeker.errors.accel_noise, 5);
  EXPECT_EQ(seeker.errors.accel_bias.value, 6);
  EXPECT_EQ(seeker.errors.accel_bias.sigma, 7);
  EXPECT_EQ(seeker.errors.range_noise, 8);
  EXPECT_EQ(seeker.errors.range_bias.value, -9);
  EXPECT_EQ(seeker.errors.range_bias.sigma, 10);
  EXPECT_EQ(seeker.errors.full_errors_beyond, 500);
  EXPECT_EQ(seeker.errors.closing_speed_noise, 11);
  EXPECT_EQ(seeker.errors.closing_speed_bias.value, -12);
  EXPECT_EQ(seeker.errors.closing_speed_bias.sigma, 13);
  EXPECT_DOUBLE_EQ(seeker.errors.field_of_view, 5 * deg);
  EXPECT_DOUBLE_EQ(seeker.loss_probability, 0.01);
  EXPECT_DOUBLE_EQ(seeker.invalid_probability, 0.02);
  EXPECT_DOUBLE_EQ(seeker.invalid_range_probability, 0.03);
  EXPECT_EQ(seeker.blackout_us, std::pair(std::int64_t{1'000'000}, std::int64_t{1'500'000}));
}

TEST(LosChecks, EveryKey) {
  const auto rate = rule_of<checks::Error>(parsed(with("kind = \"miss_distance\"\nbelow_m = 1.0",
                                                       "kind = 'error'\nquantity = 'los.rate.pitch'\n"
                                                       "time_to_go_s = [0.5, 2]\nbelow_mradps = 3",
                                                       los))
                                               .checks[0]);
  EXPECT_EQ(rate.judged.quantity->name, "los.rate.pitch");
  EXPECT_EQ(rate.stretch.to_go_s, std::pair(0.5, 2.0));
  EXPECT_DOUBLE_EQ(rate.below, 3e-3);
  const Scenario s = parsed(los);
  EXPECT_EQ(rule_of<estimators::MissDistance>(s.checks[0]).below, 1.0);
  EXPECT_EQ(s.checks[0].name, "miss_distance");
}

TEST(EngagementErrors, AreReportedInOneLine) {
  EXPECT_EQ(error_of(los_with("[engagement]", "range_km = 5")),
            "s.toml:8: key 'engagement.range_km': is unknown, expected 'range_m'");
  EXPECT_EQ(error_of(with("guidance = \"truth\"", "", los)),
            "s.toml:7: key 'engagement.guidance': is missing, expected one of: truth, target");
  EXPECT_EQ(error_of(los_with("[engagement]", "manoeuvre = \"jinx\"")),
            "s.toml:8: key 'engagement.manoeuvre': 'jinx' is unknown, expected one of: none, step, weave");
  EXPECT_EQ(error_of(los_with("[engagement]", "manoeuvre_from_s = 1\nmanoeuvre_at_to_go_s = 1")),
            "s.toml:9: key 'engagement.manoeuvre_at_to_go_s': is given beside manoeuvre_from_s, expected one "
            "of the two");
  EXPECT_EQ(error_of(los_with("[seeker]", "field_of_view_deg = 50")),
            "s.toml:10: key 'seeker.field_of_view_deg': 50 is out of range, expected a number above 0, at "
            "most 37");
  EXPECT_EQ(error_of(los_with("[seeker]", "blackout_s = [2, 1]")),
            "s.toml:10: key 'seeker.blackout_s': is descending, expected an array [low, high], each of at "
            "least 0");
}

TEST(EngagementErrors, WhatBelongsTogether) {
  EXPECT_EQ(error_of(with("[seeker]\n", "", los)), "s.toml:1: key 'seeker': is missing, expected a table");
  EXPECT_EQ(error_of(with("[engagement]\nguidance = \"truth\"\n", "", los)),
            "s.toml:1: key 'engagement': is missing, expected a table");
  EXPECT_EQ(error_of(with("[seeker]", "[slave_imu]\n[seeker]", los)),
            "s.toml:9: key 'slave_imu': depends on a truth, expected a table [truth] beside it");
}

TEST(EngagementErrors, NothingIsJudgedAgainstATruthThatIsNotThere) {
  EXPECT_EQ(error_of(with("kind = \"heartbeat\"\nsilent_at_most_s = 0.5",
                          "kind = \"miss_distance\"\nbelow_m = 1", valid)),
            "s.toml:17: key 'check[1].kind': needs a missile and its target to be judged, expected estimator "
            "los_rate in the "
            "scenario");
  EXPECT_EQ(
      error_of(with("kind = \"miss_distance\"\nbelow_m = 1.0",
                    "kind = 'error'\nquantity = 'velocity.norm'\nbelow_mps = 1", los)),
      "s.toml:12: key 'check[1].quantity': 'velocity.norm' is reported by no estimator of this scenario, "
      "expected "
      "one of: los.rate.pitch, los.rate.yaw, los.rate");
}

}  // namespace
}  // namespace canhil::plant::engagement
