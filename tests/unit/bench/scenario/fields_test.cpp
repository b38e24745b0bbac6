// Every key of a scenario except its checks: the member that it sets, its unit, and its default.
#include <gtest/gtest.h>

#include "bench/sensors/gps.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/ssbl.hpp"
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
  EXPECT_EQ(s.targets.front().estimator, "transfer_alignment");
  EXPECT_EQ(s.targets.front().algorithm, "kalman");
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.velocity, 1.0);
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.tilt, 2 * deg);
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.heading, 5 * deg);
  EXPECT_DOUBLE_EQ(s.targets.front().initial_sigma.position, 10.0);
  EXPECT_TRUE(std::ranges::all_of(s.targets.front().parameters, &Parameter::stated));
}

TEST(ScenarioFields, ParametersKeepTheUnitOfTheirNameAndTheOrderOfTheDbc) {
  const auto parameters =
      parsed(with("[truth]",
                  "[target.parameters]\nvelocity_noise_m2ps = 0.01\naccel_bias_sigma_ug = 300\n[truth]"))
          .targets.front()
          .parameters;
  ASSERT_EQ(std::ranges::count(parameters, false, &Parameter::stated), 2);
  EXPECT_EQ(parameters[0].name, "accel_bias_sigma_ug");
  EXPECT_EQ(parameters[0].value, 300.0);
  EXPECT_EQ(parameters[0].where, "s.toml:10: key 'target.parameters.accel_bias_sigma_ug'");
  EXPECT_EQ(parameters[1].name, "velocity_noise_m2ps");
  EXPECT_EQ(parameters[1].value, 0.01);
  const Setting setting{.key = "target.parameters.h2_case", .value = "3", .elements = {}};
  const auto varied = parse(valid, "s.toml", contract, {&setting, 1});
  ASSERT_TRUE(varied) << varied.error().message;
  EXPECT_EQ(varied->targets.front().parameters.at(0).where, "s.toml: key 'target.parameters.h2_case'");
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
  EXPECT_EQ(error.heading_sigma, 0.0);
  EXPECT_EQ(error.heading_magnitude, 0.0);
  const auto drawn = parsed(with("[master_ins]", "[initial_error]\nheading_sigma_deg = 30\n[master_ins]"));
  EXPECT_DOUBLE_EQ(drawn.initial_error.heading_sigma, 30 * deg);
  const auto to_a_side =
      parsed(with("[master_ins]", "[initial_error]\nheading_magnitude_deg = 90\n[master_ins]"));
  EXPECT_DOUBLE_EQ(to_a_side.initial_error.heading_magnitude, 90 * deg);
}

TEST(ScenarioFields, MasterIns) {
  const auto bare = node_of<sensors::MasterInsSettings>(parsed(valid));
  EXPECT_FALSE(bare.schedule.period_us.has_value()) << "the DBC's";
  EXPECT_EQ(bare.schedule.latency_us, 0);
  EXPECT_TRUE(bare.errors.velocity.sigma.isZero());
  const auto node = node_of<sensors::MasterInsSettings>(
      parsed(inside("[master_ins]",
                    "period_ms = 50\nlatency_ms = 12.5\n"
                    "velocity_noise_mps = 0.05\nvelocity_bias_mps = [0.1, 0, 0]\n"
                    "attitude_noise_deg = 0.01\nattitude_bias_deg = [0, 0, 1]\n"
                    "position_noise_m = [1, 1, 2]\nposition_bias_m = 3")));
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
  const auto bare = node_of<sensors::SlaveImuSettings>(parsed(valid));
  EXPECT_FALSE(bare.schedule.period_us.has_value());
  EXPECT_TRUE(bare.errors.gyro.noise.isZero() && bare.errors.accel.bias.sigma.isZero());
  const auto node = node_of<sensors::SlaveImuSettings>(
      parsed(inside("[slave_imu]",
                    "period_ms = 5\nlatency_ms = 1\nloss_percent = 2\n"
                    "accel_bias_ug = 10\naccel_bias_sigma_ug = 300\naccel_noise_ugprthz = 50\n"
                    "accel_scale_factor_ppm = 100\naccel_scale_factor_sigma_ppm = 200\n"
                    "accel_misalignment_sigma_mrad = 0.1\n"
                    "gyro_bias_degph = [1, 2, 3]\ngyro_bias_sigma_degph = 3\n"
                    "gyro_noise_degprth = 0.125\ngyro_scale_factor_ppm = 5\n"
                    "gyro_scale_factor_sigma_ppm = 6\ngyro_misalignment_sigma_mrad = 0.2")));
  EXPECT_EQ(node.schedule.period_us, 5'000);
  EXPECT_EQ(node.schedule.latency_us, 1'000);
  EXPECT_DOUBLE_EQ(node.loss_probability, 0.02);
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

TEST(ScenarioFields, TruthSPath) {
  const std::string text = with(R"(trajectory = "rest")",
                                "trajectory = \"s_path\"\nspeed_mps = 3\nheading_amplitude_deg = 50\n"
                                "turn_period_s = 33");
  const auto plain = std::get<world::SPath>(parsed(text).truth.motion);
  EXPECT_DOUBLE_EQ(plain.heading, 90 * deg);
  EXPECT_DOUBLE_EQ(plain.speed, 3.0);
  EXPECT_DOUBLE_EQ(plain.heading_amplitude, 50 * deg);
  EXPECT_DOUBLE_EQ(plain.heading_period, 33.0);
  EXPECT_DOUBLE_EQ(plain.roll_period, 33.0) << "rolls with its heading";
  EXPECT_EQ(plain.pitch_amplitude, 0.0);
  EXPECT_EQ(plain.roll_amplitude, 0.0);
  EXPECT_EQ(plain.depth.depth, 0.0);
  const auto full = std::get<world::SPath>(
      parsed(with("turn_period_s = 33",
                  "turn_period_s = 33\npitch_amplitude_deg = 2\npitch_period_s = 80\nroll_amplitude_deg = 3\n"
                  "roll_period_s = 20\ndive_depth_m = 30\ndive_period_s = 100",
                  text))
          .truth.motion);
  EXPECT_DOUBLE_EQ(full.pitch_amplitude, 2 * deg);
  EXPECT_DOUBLE_EQ(full.pitch_period, 80.0);
  EXPECT_DOUBLE_EQ(full.roll_amplitude, 3 * deg);
  EXPECT_DOUBLE_EQ(full.roll_period, 20.0);
  EXPECT_DOUBLE_EQ(full.depth.depth, 30.0);
  EXPECT_DOUBLE_EQ(full.depth.period, 100.0);
}

TEST(ScenarioFields, TruthRacetrackSpiralAndRestThenGo) {
  const auto moving = [](const std::string& lines) {
    return parsed(with(R"(trajectory = "rest")",
                       lines + "\nspeed_mps = 2\ndive_depth_m = 5\ndive_period_s = 50"))
        .truth.motion;
  };
  const auto track =
      std::get<world::Racetrack>(moving("trajectory = 'racetrack'\nleg_s = 100\nturn_s = 40\nroll_deg = 5"));
  EXPECT_DOUBLE_EQ(track.speed, 2.0);
  EXPECT_DOUBLE_EQ(track.heading, 90 * deg);
  EXPECT_DOUBLE_EQ(track.leg, 100.0);
  EXPECT_DOUBLE_EQ(track.turn, 40.0);
  EXPECT_DOUBLE_EQ(track.roll, 5 * deg);
  EXPECT_DOUBLE_EQ(track.depth.depth, 5.0);
  const auto spiral =
      std::get<world::Spiral>(moving("trajectory = 'spiral'\nturn_period_s = 60\nroll_deg = -5"));
  EXPECT_DOUBLE_EQ(spiral.period, 60.0);
  EXPECT_DOUBLE_EQ(spiral.roll, -5 * deg);
  EXPECT_DOUBLE_EQ(spiral.depth.period, 50.0);
  const auto going =
      std::get<world::RestThenGo>(moving("trajectory = 'rest_then_go'\nrest_s = 60\nstart_s = 10"));
  EXPECT_DOUBLE_EQ(going.rest, 60.0);
  EXPECT_DOUBLE_EQ(going.start, 10.0);
  EXPECT_DOUBLE_EQ(going.depth.depth, 5.0);
}

std::string aided(const std::string& aid) {
  return with("[slave_imu]", "[slave_imu]\n" + aid, with("transfer_alignment", "inflight_alignment"));
}

TEST(ScenarioFields, Ssbl) {
  const auto bare = node_of<sensors::SsblSettings>(parsed(aided("[ssbl]")));
  EXPECT_FALSE(bare.schedule.period_us.has_value());
  EXPECT_TRUE(bare.noise.isZero() && bare.bias.sigma.isZero() && bare.ship_error.sigma.isZero());
  EXPECT_FALSE(bare.faults.silence_us.has_value());
  const auto node = node_of<sensors::SsblSettings>(
      parsed(aided("[ssbl]\nperiod_ms = 2000\nlatency_ms = 1500\n"
                   "ship_offset_m = [100, 200, -10]\nship_velocity_mps = [1, 2, 0]\n"
                   "ship_error_m = 4\nship_error_sigma_m = 3\nbias_m = [1, 0, 0]\nbias_sigma_m = 1\n"
                   "noise_m = 2\nrange_noise_percent = 0.5\nloss_percent = 5\ninvalid_percent = 4\n"
                   "outlier_percent = 3\noutlier_m = 1000\nsilence_s = [5, 6.5]")));
  EXPECT_EQ(node.schedule.period_us, 2'000'000);
  EXPECT_EQ(node.schedule.latency_us, 1'500'000);
  expect_near(node.ship_offset, {100, 200, -10});
  expect_near(node.ship_velocity, {1, 2, 0});
  expect_near(node.ship_error.value, {4, 4, 4});
  expect_near(node.ship_error.sigma, {3, 3, 3});
  expect_near(node.bias.value, {1, 0, 0});
  expect_near(node.bias.sigma, {1, 1, 1});
  expect_near(node.noise, {2, 2, 2});
  EXPECT_DOUBLE_EQ(node.range_noise, 0.005);
  EXPECT_DOUBLE_EQ(node.faults.loss_probability, 0.05);
  EXPECT_DOUBLE_EQ(node.faults.invalid_probability, 0.04);
  EXPECT_DOUBLE_EQ(node.faults.outlier_probability, 0.03);
  EXPECT_DOUBLE_EQ(node.faults.outlier, 1000.0);
  EXPECT_EQ(node.faults.silence_us, std::pair(std::int64_t{5'000'000}, std::int64_t{6'500'000}));
}

TEST(ScenarioFields, OutliersOfNoShareAreNone) {  // for example the first point of a sweep
  const auto faults =
      node_of<sensors::SsblSettings>(parsed(aided("[ssbl]\noutlier_percent = 0\noutlier_m = 200"))).faults;
  EXPECT_EQ(faults.outlier_probability, 0);
  EXPECT_EQ(faults.outlier, 200);
}

TEST(ScenarioFields, Gps) {
  const auto bare = node_of<sensors::GpsSettings>(parsed(aided("[gps]")));
  EXPECT_FALSE(bare.lowest_height.has_value());
  EXPECT_TRUE(bare.noise.isZero() && bare.bias.sigma.isZero());
  const auto node = node_of<sensors::GpsSettings>(
      parsed(aided("[gps]\nlatency_ms = 100\nbias_m = 1\nbias_sigma_m = [2, 2, 3]\n"
                   "noise_m = [10, 10, 15]\nlowest_height_m = -0.5\nloss_percent = 7")));
  EXPECT_EQ(node.schedule.latency_us, 100'000);
  expect_near(node.bias.value, {1, 1, 1});
  expect_near(node.bias.sigma, {2, 2, 3});
  expect_near(node.noise, {10, 10, 15});
  EXPECT_EQ(node.lowest_height, -0.5);
  EXPECT_DOUBLE_EQ(node.faults.loss_probability, 0.07);
}

TEST(ScenarioFields, NodesAreOnTheBusOnlyIfNamed) {
  const std::string text = with("[master_ins]\n[slave_imu]\n", "[slave_imu]\n[gps]\n",
                                with("transfer_alignment", "inflight_alignment"));
  const Scenario s = parsed(text);
  EXPECT_FALSE(s.node("master_ins"));
  EXPECT_TRUE(s.node("slave_imu"));
  EXPECT_FALSE(s.node("ssbl"));
  EXPECT_TRUE(s.node("gps"));
}

}  // namespace
}  // namespace canhil::scenario
