// Every field of a scenario but its checks: where it goes, in which unit, and what it is when absent.
#include <gtest/gtest.h>

#include "bench/world/hash.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using world::Vector3;
using namespace world::units;

void expect_near(const Vector3& a, const Vector3& b) {
  EXPECT_LT((a - b).norm(), 1e-12 * b.norm() + 1e-300) << a;
}

TEST(ScenarioFields, Top) {
  const Scenario s = parsed(valid);
  EXPECT_EQ(s.file, "s.toml");
  EXPECT_EQ(s.title, "A title");
  EXPECT_EQ(s.duration_us, 20'000'000);
  EXPECT_EQ(s.seed, 7U);
  EXPECT_EQ(s.hash, world::fnv1a_64(valid));
  EXPECT_NE(parsed(with("seed = 7", "seed = 8")).hash, s.hash);
}

TEST(ScenarioFields, Target) {
  const Scenario s = parsed(valid);
  EXPECT_EQ(s.target.estimator, "transfer_alignment");
  EXPECT_EQ(s.target.algorithm, "kalman");
  EXPECT_DOUBLE_EQ(s.target.initial_sigma.velocity, 1.0);
  EXPECT_DOUBLE_EQ(s.target.initial_sigma.tilt, 2 * deg);
  EXPECT_DOUBLE_EQ(s.target.initial_sigma.heading, 5 * deg);
  EXPECT_DOUBLE_EQ(s.target.initial_sigma.position, 10.0);
  EXPECT_TRUE(s.target.parameters.empty());
}

TEST(ScenarioFields, ParametersKeepTheUnitOfTheirNameAndTheOrderOfTheDbc) {
  const auto parameters =
      parsed(with("[truth]",
                  "[target.parameters]\nvelocity_noise_m2ps = 0.01\naccel_bias_sigma_ug = 300\n[truth]"))
          .target.parameters;
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].name, "accel_bias_sigma_ug");
  EXPECT_EQ(parameters[0].value, 300.0);
  EXPECT_EQ(parameters[0].where, "s.toml:10: key 'target.parameters.accel_bias_sigma_ug'");
  EXPECT_EQ(parameters[1].name, "velocity_noise_m2ps");
  EXPECT_EQ(parameters[1].value, 0.01);
  const Setting setting{.key = "target.parameters.h2_case", .value = "3", .elements = {}};
  const auto varied = parse(valid, "s.toml", contract, {&setting, 1});
  ASSERT_TRUE(varied) << varied.error().message;
  EXPECT_EQ(varied->target.parameters.at(0).where, "s.toml: key 'target.parameters.h2_case'");
}

TEST(ScenarioFields, TruthAtRest) {
  const Scenario s = parsed(valid);
  EXPECT_DOUBLE_EQ(s.truth.start.latitude, 37 * deg);
  EXPECT_DOUBLE_EQ(s.truth.start.longitude, 127 * deg);
  EXPECT_DOUBLE_EQ(s.truth.start.height, 1000.0);
  const auto& rest = std::get<world::Rest>(s.truth.motion);
  EXPECT_EQ(rest.angles.roll, 0.0);
  EXPECT_EQ(rest.angles.pitch, 0.0);
  EXPECT_DOUBLE_EQ(rest.angles.heading, 90 * deg);
  const Scenario tilted = parsed(inside("[truth]", "roll_deg = 1\npitch_deg = -2"));
  EXPECT_DOUBLE_EQ(std::get<world::Rest>(tilted.truth.motion).angles.roll, 1 * deg);
  EXPECT_DOUBLE_EQ(std::get<world::Rest>(tilted.truth.motion).angles.pitch, -2 * deg);
}

TEST(ScenarioFields, TruthLevelAcceleration) {
  const Scenario s = parsed(
      with(R"(trajectory = "rest")",
           "trajectory = \"level_acceleration\"\nspeed_kmph = 360\ncruise_s = 10.0\nacceleration_g = 0.5"));
  const auto& motion = std::get<world::LevelAcceleration>(s.truth.motion);
  EXPECT_DOUBLE_EQ(motion.heading, 90 * deg);
  EXPECT_DOUBLE_EQ(motion.speed, 100.0);
  EXPECT_EQ(motion.cruise_us, 10'000'000);
  EXPECT_DOUBLE_EQ(motion.acceleration, 4.903325);
}

TEST(ScenarioFields, TruthWeave) {
  const std::string text = with(R"(trajectory = "rest")",
                                "trajectory = \"weave\"\nspeed_kmph = 360\nheading_amplitude_deg = 20\n"
                                "turn_period_s = 12");
  const auto plain = std::get<world::Weave>(parsed(text).truth.motion);
  EXPECT_DOUBLE_EQ(plain.heading, 90 * deg);
  EXPECT_DOUBLE_EQ(plain.speed, 100.0);
  EXPECT_DOUBLE_EQ(plain.heading_amplitude, 20 * deg);
  EXPECT_DOUBLE_EQ(plain.turn_period, 12.0);
  EXPECT_EQ(plain.pitch_amplitude, 0.0);
  EXPECT_EQ(plain.coning_amplitude, 0.0);
  const auto full =
      std::get<world::Weave>(parsed(with("turn_period_s = 12",
                                         "turn_period_s = 12\npitch_amplitude_deg = 3\npitch_period_s = 7\n"
                                         "coning_amplitude_deg = 0.1\nconing_period_ms = 50",
                                         text))
                                 .truth.motion);
  EXPECT_DOUBLE_EQ(full.pitch_amplitude, 3 * deg);
  EXPECT_DOUBLE_EQ(full.pitch_period, 7.0);
  EXPECT_DOUBLE_EQ(full.coning_amplitude, 0.1 * deg);
  EXPECT_DOUBLE_EQ(full.coning_period, 0.05);
}

TEST(ScenarioFields, InitialErrorIsFixedOrDrawnForOneOrThreeAxes) {
  const auto none = parsed(valid).initial_error;
  EXPECT_TRUE(none.position.value.isZero() && none.position.sigma.isZero() && none.velocity.value.isZero() &&
              none.velocity.sigma.isZero() && none.attitude.value.isZero() && none.attitude.sigma.isZero());
  const auto error = parsed(with("[master_ins]",
                                 "[initial_error]\nposition_m = [1, 2, 3]\nposition_sigma_m = 4\n"
                                 "velocity_mps = 1.5\nvelocity_sigma_mps = [0, 0, 2.0]\n"
                                 "attitude_deg = [5, -5, 5.0]\nattitude_sigma_deg = 1\n[master_ins]"))
                         .initial_error;
  expect_near(error.position.value, {1, 2, 3});
  expect_near(error.position.sigma, {4, 4, 4});
  expect_near(error.velocity.value, {1.5, 1.5, 1.5});
  expect_near(error.velocity.sigma, {0, 0, 2});
  expect_near(error.attitude.value, Vector3(5, -5, 5) * deg);
  expect_near(error.attitude.sigma, Vector3(1, 1, 1) * deg);
}

TEST(ScenarioFields, MasterIns) {
  const auto bare = parsed(valid).master_ins.value();
  EXPECT_FALSE(bare.schedule.period_us.has_value()) << "the DBC's";
  EXPECT_EQ(bare.schedule.latency_us, 0);
  EXPECT_TRUE(bare.errors.velocity.sigma.isZero());
  const auto node = parsed(inside("[master_ins]",
                                  "period_ms = 50\nlatency_ms = 12.5\n"
                                  "velocity_noise_mps = 0.05\nvelocity_bias_mps = [0.1, 0, 0]\n"
                                  "attitude_noise_deg = 0.01\nattitude_bias_deg = [0, 0, 1]\n"
                                  "position_noise_m = [1, 1, 2]\nposition_bias_m = 3"))
                        .master_ins.value();
  EXPECT_EQ(node.schedule.period_us, 50'000);
  EXPECT_EQ(node.schedule.latency_us, 12'500);
  expect_near(node.errors.velocity.sigma, {0.05, 0.05, 0.05});
  expect_near(node.errors.velocity.value, {0.1, 0, 0});
  expect_near(node.errors.attitude.sigma, Vector3::Constant(0.01 * deg));
  expect_near(node.errors.attitude.value, {0, 0, 1 * deg});
  expect_near(node.errors.position.sigma, {1, 1, 2});
  expect_near(node.errors.position.value, {3, 3, 3});
}

TEST(ScenarioFields, SlaveImu) {
  const auto bare = parsed(valid).slave_imu.value();
  EXPECT_FALSE(bare.schedule.period_us.has_value());
  EXPECT_TRUE(bare.errors.gyro.noise.isZero() && bare.errors.accel.bias.sigma.isZero());
  const auto node = parsed(inside("[slave_imu]",
                                  "period_ms = 5\nlatency_ms = 1\n"
                                  "accel_bias_ug = 10\naccel_bias_sigma_ug = 300\naccel_noise_ugprthz = 50\n"
                                  "accel_scale_factor_ppm = 100\naccel_scale_factor_sigma_ppm = 200\n"
                                  "accel_misalignment_sigma_mrad = 0.1\n"
                                  "gyro_bias_degph = [1, 2, 3]\ngyro_bias_sigma_degph = 3\n"
                                  "gyro_noise_degprth = 0.125\ngyro_scale_factor_ppm = 5\n"
                                  "gyro_scale_factor_sigma_ppm = 6\ngyro_misalignment_sigma_mrad = 0.2"))
                        .slave_imu.value();
  EXPECT_EQ(node.schedule.period_us, 5'000);
  EXPECT_EQ(node.schedule.latency_us, 1'000);
  const auto& accel = node.errors.accel;
  expect_near(accel.bias.value, Vector3::Constant(9.80665e-5));
  expect_near(accel.bias.sigma, Vector3::Constant(2.941995e-3));
  expect_near(accel.noise, Vector3::Constant(4.903325e-4));  // m/s per sqrt(s)
  expect_near(accel.scale_factor.value, Vector3::Constant(1e-4));
  expect_near(accel.scale_factor.sigma, Vector3::Constant(2e-4));
  EXPECT_DOUBLE_EQ(accel.misalignment_sigma, 1e-4);
  const auto& gyro = node.errors.gyro;
  expect_near(gyro.bias.value, Vector3(1, 2, 3) * deg / 3600);
  expect_near(gyro.bias.sigma, Vector3::Constant(3 * deg / 3600));
  expect_near(gyro.noise, Vector3::Constant(0.125 * deg / 60));  // rad per sqrt(s)
  expect_near(gyro.scale_factor.value, Vector3::Constant(5e-6));
  expect_near(gyro.scale_factor.sigma, Vector3::Constant(6e-6));
  EXPECT_DOUBLE_EQ(gyro.misalignment_sigma, 2e-4);
}

TEST(ScenarioFields, NodesAreOnTheBusOnlyIfNamed) {
  const std::string text =
      with("[master_ins]\n[slave_imu]\n", "[slave_imu]\n", with("transfer_alignment", "inflight_alignment"));
  const Scenario s = parsed(text);
  EXPECT_FALSE(s.master_ins.has_value());
  EXPECT_TRUE(s.slave_imu.has_value());
}

}  // namespace
}  // namespace canhil::scenario
