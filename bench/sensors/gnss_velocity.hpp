// The velocity that a GNSS receiver measures, with speed and course over ground.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [gnss_velocity].
struct GnssVelocitySettings {
  scenario::Schedule schedule{};
  world::Vector3 lever_arm = world::Vector3::Zero();  ///< from the IMU to the antenna, body axes [m]
  world::RandomConstant bias{};                       ///< NED [m/s]
  world::Vector3 noise = world::Vector3::Zero();      ///< white, 1-sigma of a sample, NED [m/s]
  double correlated = 0;                              ///< 1-sigma of a Gauss-Markov process per axis [m/s]
  double correlation_s = 60;                          ///< its correlation time [s]
  double invalid_probability = 0;
  SampleLoss loss{};
};

extern const struct Kind gnss_velocity;

}  // namespace canhil::sensors
