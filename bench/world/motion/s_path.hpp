// S-turns about a mean heading: the path of an underwater vehicle in Kang, Kim, Park (2006). Straight with an
// amplitude of 0.
#pragma once

#include "bench/world/kinematics.hpp"
#include "bench/world/motion/depth_profile.hpp"

namespace canhil::world {

/// heading + heading_amplitude sin(w_h t), pitch_amplitude sin(w_p t), roll_amplitude cos(w_r t): with
/// roll_period = heading_period it rolls with its heading rate.
struct SPath {
  double speed = 0;              ///< constant, along the nose [m/s]
  double heading = 0;            ///< mean [rad]
  double heading_amplitude = 0;  ///< [rad]
  double heading_period = 1;     ///< [s]
  double pitch_amplitude = 0;    ///< about that of the depth profile [rad]
  double pitch_period = 1;       ///< [s]
  double roll_amplitude = 0;     ///< [rad]
  double roll_period = 1;        ///< [s]
  DepthProfile depth;
};

Kinematics kinematics(const SPath& motion, double t);

}  // namespace canhil::world
