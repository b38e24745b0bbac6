// The measurements of a seeker. Defaults: an active radar whose error is dominated by thermal noise beyond
// 1710 m and by glint below this range.
#pragma once

#include "bench/world/attitude.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/stream.hpp"
#include "bench/world/units.hpp"

namespace canhil::sensors {

namespace units = world::units;
using world::Planes;
using world::RandomValue;
using world::Stream;
using world::Vector3;

/// Each noise is given as the 1-sigma of a sample. All noises are white except the glint. The correlation of
/// the glint is exp(-t / tau).
struct SeekerErrorModel {
  double thermal = 1e-10;                              ///< thermal noise divided by range^2 [rad/m^2]
  double glint = 0.5;                                  ///< glint noise multiplied by the range [m]
  double glint_correlation = 0;                        ///< tau of the glint [s]; 0: white
  double constant = 0;                                 ///< range-independent noise of the error angle [rad]
  double gyro_noise = 1e-3;                            ///< noise of the mean antenna rate [rad/s]
  RandomValue gyro_bias{.value = 0, .sigma = 0.5e-3};  ///< of each axis [rad/s]
  double accel_noise = 0.3;                            ///< [m/s^2]
  RandomValue accel_bias{.value = 0, .sigma = 0.2};    ///< of each axis [m/s^2]
  double range_noise = 5;  ///< beyond `full_errors_beyond`; at shorter range, proportional to range [m]
  RandomValue range_bias{.value = 0, .sigma = 15};         ///< varies with range as range_noise does [m]
  double full_errors_beyond = 1000;                        ///< [m]
  double closing_speed_noise = 3;                          ///< [m/s]
  RandomValue closing_speed_bias{.value = 0, .sigma = 5};  ///< [m/s]
  double field_of_view = 8 * units::deg;                   ///< the largest measurable error angle [rad]
};

/// What a seeker measures: the values at a time, and the integrals over the interval before it.
struct SeekerTruth {
  std::int64_t t_us = 0;
  std::int64_t interval_us = 0;
  double range = 0;                             ///< [m]
  double closing_speed = 0;                     ///< [m/s]
  Planes<double> error{};                       ///< line of sight relative to the antenna's axis [rad]
  Vector3 delta_theta = Vector3::Zero();        ///< inertial rotation of the antenna: roll, pitch, yaw [rad]
  Vector3 mean_acceleration = Vector3::Zero();  ///< of the missile, axes of the antenna [m/s^2]
};

/// One sample.
struct SeekerMeasurement {
  std::int64_t t_us = 0;
  std::int64_t interval_us = 0;
  Planes<double> error{};                 ///< [rad]
  bool in_view = true;                    ///< false: the error angles are invalid
  Vector3 antenna = Vector3::Zero();      ///< increment: roll, pitch, yaw [rad]
  Planes<double> missile_acceleration{};  ///< mean over the interval, along z (pitch) and y (yaw) [m/s^2]
  double range = 0;                       ///< [m]
  double closing_speed = 0;               ///< [m/s]
};

class ErroneousSeeker {
 public:
  ErroneousSeeker(const SeekerErrorModel& model, Stream stream);

  /// Takes thirteen numbers from the stream, whatever the sigmas are.
  SeekerMeasurement measure(const SeekerTruth& truth);

 private:
  Planes<double> glint(double dt);

  SeekerErrorModel model_;
  Stream stream_;
  Vector3 gyro_bias_;
  Planes<double> accel_bias_{};
  double range_bias_, closing_speed_bias_;
  Planes<double> glint_{};  // current glint, unit variance
  bool glinting_ = false;
};

}  // namespace canhil::sensors
