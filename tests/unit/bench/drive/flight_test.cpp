// Tests the largest IMU errors whose increments still fit into their signals, and the order in which the
// nodes send.
#include "bench/drive/flight.hpp"

#include <gmock/gmock.h>

#include "bench/drive/contract.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/sensors/slave_imu.hpp"

namespace canhil::drive {
namespace {

using testing::HasSubstr;
using world::Vector3;

constexpr double dt = 0.01;
constexpr double widest_rad = 0.131;  // limit of SlaveImuDeltaTheta
constexpr double widest_mps = 1.31;   // limit of SlaveImuDeltaV

class ImuLimits : public testing::Test {
 protected:
  ImuLimits()
      : scenario_(
            *scenario::read_file(SOURCE_DIR "/bench/flights/transfer_alignment_quick.toml", contract())),
        truth_(*make_truth(scenario_)) {}

  [[nodiscard]] std::string refused(const world::ImuErrorModel& imu) const {
    const auto fits = nodes::bound(sensors::slave_imu).fits(with(imu), scenario_, truth_);
    return fits ? "" : fits.error().message;
  }

  static scenario::NodeSettings with(const world::ImuErrorModel& imu) {
    return {nodes::bound(sensors::slave_imu).table, sensors::SlaveImuSettings{.errors = imu}};
  }

  scenario::Scenario scenario_;
  world::FlightRecord truth_;  // 1 g ahead and 1 g up: 0.098 m/s per sample on two axes, hardly any rotation
};

TEST_F(ImuLimits, AnHonestImuFits) {
  EXPECT_EQ(refused(scenario_.node("slave_imu")->own<sensors::SlaveImuSettings>()->errors), "");
}

TEST_F(ImuLimits, EachErrorIsRefusedWhereItsSixSigmaLeaveTheRangeAndNotBefore) {
  for (const double share : {0.9, 1.1}) {
    const auto expect = [&](const world::ImuErrorModel& imu, const std::string& key) {
      if (share < 1) {
        EXPECT_EQ(refused(imu), "") << key;
      } else {
        EXPECT_THAT(refused(imu), HasSubstr(key));
      }
    };
    const Vector3 east = Vector3::UnitY();  // on this axis the flight has neither rotation nor acceleration
    world::ImuErrorModel imu;
    imu.gyro.bias.value = -share * widest_rad / dt * east;
    expect(imu, "'slave_imu.gyro_bias_degph'");
    imu = {};
    imu.gyro.bias.sigma = share * widest_rad / dt / 6 * east;
    expect(imu, "'slave_imu.gyro_bias_sigma_degph'");
    imu = {};
    imu.gyro.noise = share * widest_rad / std::sqrt(dt) / 6 * east;
    expect(imu, "'slave_imu.gyro_noise_degprth'");
    imu = {};
    imu.accel.bias.value = share * widest_mps / dt * east;
    expect(imu, "'slave_imu.accel_bias_ug'");
    imu = {};
    imu.accel.bias.sigma = share * widest_mps / dt / 6 * east;
    expect(imu, "'slave_imu.accel_bias_sigma_ug'");
    imu = {};
    imu.accel.noise = share * widest_mps / std::sqrt(dt) / 6 * east;
    expect(imu, "'slave_imu.accel_noise_ugprthz'");
  }
}

TEST_F(ImuLimits, ErrorsInProportionToTheFlightAreNamedToo) {
  world::ImuErrorModel imu;
  imu.accel.scale_factor.value = Vector3::Constant(-15);
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.accel_scale_factor_ppm'"));
  imu = {};
  imu.accel.scale_factor.sigma = Vector3::Constant(2.5);
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.accel_scale_factor_sigma_ppm'"));
  imu = {};
  imu.accel.misalignment_sigma = 2.5;
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.accel_misalignment_sigma_mrad'"));
}

TEST_F(ImuLimits, TheErrorStackIsNamedAndItsRangeCounts) {
  world::ImuErrorModel imu;
  imu.gyro.stacks[1].correlated = widest_rad / dt / 5;
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.gyro_bias_instability_degph'"));
  imu.gyro.stacks[1].highest =
      0.9 * widest_rad / dt;  // what the IMU cannot measure, the signal need not hold
  EXPECT_EQ(refused(imu), "");
  imu = {};
  imu.accel.stacks[1].random_walk =
      widest_mps / dt / std::sqrt(1e-6 * static_cast<double>(truth_.end_us())) / 5;
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.accel_random_walk_ugprth'"));
  imu = {};
  imu.g_sensitivity = Vector3(2, 0, 0);  // 1 g ahead is 0.098 m/s
  EXPECT_THAT(refused(imu), HasSubstr("'slave_imu.gyro_g_sensitivity_degph_per_g'"));
  imu = {};
  imu.accel.bias_per_k = Vector3(0, 2 * widest_mps / dt / 50, 0);
  imu.temperature.rise = 50;
  EXPECT_THAT(refused(imu), HasSubstr("the temperature (largest part)"));
}

TEST_F(ImuLimits, WhatIsAcceptedNeverLeavesTheRange) {
  world::ImuErrorModel imu;
  imu.accel.bias.sigma = Vector3::Constant(7);  // 6 sigma are 0.42 m/s per sample
  imu.accel.noise = Vector3::Constant(1);       // 6 sigma are 0.6 m/s per sample
  imu.accel.scale_factor.sigma = Vector3::Constant(0.2);
  imu.accel.misalignment_sigma = 0.1;
  ASSERT_EQ(refused(imu), "");
  double largest = 0;
  for (std::uint64_t run = 0; run < 200; ++run) {
    world::ErroneousImu drawn(imu, world::ImuStreams::of("slave_imu", [run](const std::string& name) {
                                return world::Stream(1, run, name);
                              }));
    for (const auto& exact : truth_.increments())
      largest = std::max(largest, drawn.measure(exact).delta_v.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(largest, widest_mps);
  EXPECT_GT(largest, widest_mps / 2) << "too tame to show anything";
}

TEST_F(ImuLimits, AScenarioThatSaturatesIsRefusedWithItsTruth) {
  world::ImuErrorModel imu;
  imu.gyro.bias.sigma = Vector3::Constant(4848);  // 1e9 deg/h
  scenario_.nodes.assign(1, with(imu));
  const auto truth = make_truth(scenario_);
  ASSERT_FALSE(truth);
  EXPECT_THAT(truth.error().message,
              HasSubstr("'slave_imu.gyro_bias_sigma_degph' (largest part): an IMU increment of up to 290"));
  EXPECT_THAT(truth.error().message, HasSubstr("SlaveImuDeltaTheta.delta_theta_x_rad, expected -0.131 to"));
  scenario_.nodes.clear();
  EXPECT_TRUE(make_truth(scenario_));
}

// The frames and counters of every recorded run depend on this order.
TEST(Nodes, SendInAnOrderThatNeverChanges) {
  const auto all = scenario::read_file(SOURCE_DIR "/bench/flights/all_four.toml", contract()).value();
  const world::FlightRecord truth = make_truth(all).value();
  Flight flight = make_flight(all, truth, 0).value();
  PerRunTruth& own = flight.per_run_truth;
  const auto sensors = nodes::make({.scenario = all, .index = 0, .flight = truth, .plants = plants_of(own)});
  for (plant::Simulation* one : own.plants()) one->advance(all.duration_us);
  std::vector<std::string_view> senders;
  for (const auto& node : sensors) {
    nodes::Transmission out;
    while (out.frames().empty()) node->transmit(out);  // skips samples that the node loses on purpose
    senders.push_back(messages::find_message(out.frames().front().id)->sender);
  }
  EXPECT_THAT(senders,
              testing::ElementsAre("SlaveImu", "MasterIns", "Ssbl", "Gps", "Fins", "GliderNav", "Seeker"));
}

}  // namespace
}  // namespace canhil::drive
