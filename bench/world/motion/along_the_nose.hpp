// Motions of a vehicle along its nose: velocity follows from speed and attitude. The vehicle may dive and
// surface repeatedly.
#pragma once

#include "bench/world/kinematics.hpp"

namespace canhil::world {

/// Depth below the start: depth (1 - cos(2 pi t / period)) / 2.
struct DepthProfile {
  double depth = 0;   ///< deepest point below the start [m]
  double period = 1;  ///< from surface to surface [s]
};

/// The largest vertical speed of a profile [m/s]: pi depth / period.
double steepest(const DepthProfile& profile);

/// S-turns about a mean heading: the path of an underwater vehicle in Kang, Kim, Park (2006). With amplitude
/// 0 the path is straight.
///
/// The heading at time t is the mean `heading` plus heading_amplitude sin(w_h t). The roll is roll_amplitude
/// cos(w_r t). The pitch is that of the dive plus pitch_amplitude sin(w_p t). If roll_period equals
/// heading_period, the roll is in phase with the heading rate.
struct SPath {
  double speed = 0;              ///< constant, along the nose [m/s]
  double heading = 0;            ///< mean [rad]
  double heading_amplitude = 0;  ///< [rad]
  double heading_period = 1;     ///< [s]
  double pitch_amplitude = 0;    ///< relative to the depth profile [rad]
  double pitch_period = 1;       ///< [s]
  double roll_amplitude = 0;     ///< [rad]
  double roll_period = 1;        ///< [s]
  DepthProfile depth;
};

Kinematics kinematics(const SPath& motion, double t);

/// Straight legs joined by half turns to the right: a leg, a half turn, a leg, ... During a turn, the turn
/// rate is pi / turn (1 - cos(2 pi tau / turn)). The turn rate and the roll rise and fall smoothly, so
/// acceleration and angular rate have no jumps.
struct Racetrack {
  double speed = 0;    ///< constant, along the nose [m/s]
  double heading = 0;  ///< of the first leg [rad]
  double leg = 1;      ///< time of a leg [s]
  double turn = 1;     ///< time of a half turn [s]
  double roll = 0;     ///< roll angle in the middle of a turn [rad]
  DepthProfile depth;
};

Kinematics kinematics(const Racetrack& motion, double t);

/// Circling at a constant rate: a helix with a depth profile.
struct Spiral {
  double speed = 0;    ///< constant, along the nose [m/s]
  double heading = 0;  ///< at the start [rad]
  double period = 1;   ///< time of a full turn to the right [s]
  double roll = 0;     ///< constant [rad]
  DepthProfile depth;
};

Kinematics kinematics(const Spiral& motion, double t);

/// The vehicle is at rest for a while, then accelerates to a constant speed along the nose. The acceleration
/// is speed / start (1 - cos(2 pi tau / start)); it rises and falls smoothly, so it has no jumps. The dive
/// begins with the acceleration.
struct RestThenGo {
  double speed = 0;    ///< final [m/s]
  double heading = 0;  ///< [rad]
  double rest = 0;     ///< time at rest [s]
  double start = 1;    ///< duration of the acceleration [s]
  DepthProfile depth;
};

Kinematics kinematics(const RestThenGo& motion, double t);

}  // namespace canhil::world
