#pragma once
// What antenna and missile do between samples, and what is believed of it where samples were lost.
#include <complex>

namespace canhil::los_rate {

/// A pair of planes as yaw + j pitch: angles and rates z + j y, accelerations y - j z (antenna axes, x
/// forward, y right, z down). Then both planes obey the same equations and roll turns them by exp(j phi).
using Plane = std::complex<double>;

/// Means over one sample, in the antenna's axes.
struct Motion {
  Plane antenna_rate;          // inertial [rad/s]
  double roll_rate = 0;        // inertial [rad/s]
  Plane missile_acceleration;  // gravity included [m/s^2]
};

/// A part of a step, and 1 sigma in each plane of what is not known of it.
struct Leg {
  double dt = 0;               // [s]
  Plane antenna_increment;     // [rad]
  double roll_increment = 0;   // [rad]
  Plane missile_acceleration;  // mean [m/s^2]
  double turn = 0;             // of the antenna's increment [rad]
  double pull = 0;             // of the missile's velocity [m/s]
};

/// Lost samples of `gap` [s] between two that were measured: the mean of both. Where a rate steps from one to
/// the other at a time that may be any, its integral is wrong by a uniform +-|change| gap/2, whose sigma is
/// |change| gap/sqrt(12); of the change of both planes, each has half of the square.
Leg bridge(const Motion& before, const Motion& after, double gap);

}  // namespace canhil::los_rate
