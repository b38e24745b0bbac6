#pragma once
// A transfer-alignment filter in mid-flight, ready for one more IMU sample or one more update.
#include "target/estimators/transfer_alignment/filter.hpp"
#include "tests/unit/target/estimators/flight.hpp"

namespace canhil::transfer_alignment {

struct WarmFilter {
  Settings settings;
  State state;  // 0.1 s after the last update
  strapdown::ImuIncrement imu;
  Eigen::Vector3d master_velocity;
};

/// The settings of a target that is told nothing: it considers the errors of ordinary sensors.
inline Settings with_ordinary_sensors() {
  Settings settings;
  settings.accel_scale_factor_sigma = settings.gyro_scale_factor_sigma = 300e-6;
  settings.accel_misalignment_sigma = settings.gyro_misalignment_sigma = 0.5e-3;
  settings.lever_arm_sigma = 0.5;
  settings.velocity_correlated_sigma = 0.05;
  return settings;
}

inline WarmFilter warm_filter(Algorithm algorithm, strapdown::Mechanization mechanization,
                              Loop loop = Loop::published, const Settings& settings = {}) {
  WarmFilter filter;
  filter.settings = settings;
  filter.settings.algorithm = algorithm;
  filter.settings.mechanization = mechanization;
  filter.settings.loop = loop;
  filter.state = initial(published_start(), filter.settings);
  strapdown::NavState truth = flight_start();
  for (int k = 0; k < 1200; ++k) {
    filter.imu = flight_increment(truth, k * 0.01, 0.01);
    propagate(filter.state, filter.imu, filter.settings);
    truth = flight_next(truth, k * 0.01, 0.01);
    if (k % 10 == 9 && k < 1190) update(filter.state, truth.v_eb_n, filter.settings);
  }
  filter.master_velocity = truth.v_eb_n;
  return filter;
}

}  // namespace canhil::transfer_alignment
