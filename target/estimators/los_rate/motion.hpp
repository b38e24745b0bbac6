#pragma once
// The motion of antenna and missile between samples, and its interpolation where samples were lost.
#include <complex>

namespace canhil::los_rate {

/// A pair of planes as the complex number yaw + j pitch. Angles and rates are z + j y, and accelerations are
/// y - j z (antenna axes: x forward, y right, z down). Then both planes obey the same equations, and a roll
/// by phi multiplies the number by exp(j phi).
using Plane = std::complex<double>;

/// Means over one sample, in the antenna's axes.
struct Motion {
  Plane antenna_rate;          // inertial [rad/s]
  double roll_rate = 0;        // inertial [rad/s]
  Plane missile_acceleration;  // gravity included [m/s^2]
};

/// A part of a step, with the 1-sigma uncertainty of its motion in each plane.
struct Leg {
  double dt = 0;               // [s]
  Plane antenna_increment;     // [rad]
  double roll_increment = 0;   // [rad]
  Plane missile_acceleration;  // mean [m/s^2]
  double turn = 0;             // sigma of the antenna's increment [rad]
  double pull = 0;             // sigma of the change of the missile's velocity [m/s]
};

/// Bridges lost samples over `gap` [s] with the mean of the motions before and after the gap. If the motion
/// changes abruptly at a random time in the gap, the error of its integral is uniform within
/// +-|change| gap/2, so the sigma of this error is |change| gap/sqrt(12). The squared changes of both planes
/// are added, and each plane gets half of this sum.
Leg bridge(const Motion& before, const Motion& after, double gap);

}  // namespace canhil::los_rate
