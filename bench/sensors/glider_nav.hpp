// The GPS/INS of the glider: ground velocity, attitude, rates and height.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// The table [glider_nav].
struct GliderNavSettings {
  scenario::Schedule schedule{};
  double velocity_noise = 0;  ///< 1-sigma of each component, NED [m/s]
  double rate_noise = 0;      ///< body [rad/s]
  double attitude_noise = 0;  ///< roll, pitch, heading [rad]
  /// The fraction of the variance that comes from a first-order Gauss-Markov process. The rest of the
  /// variance is white noise.
  double correlated_fraction = 0;
  double correlation_time = 60;           ///< [s]
  world::RandomConstant velocity_bias{};  ///< NED [m/s]
  world::RandomConstant attitude_bias{};  ///< roll, pitch, heading [rad]
  SampleLoss loss{};
};

extern const struct Kind glider_nav;

}  // namespace canhil::sensors
