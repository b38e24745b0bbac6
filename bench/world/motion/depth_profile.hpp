// Diving and surfacing, again and again: the depth of a motion.
#pragma once

namespace canhil::world {

/// Below the start by depth (1 - cos(2 pi t / period)) / 2.
struct DepthProfile {
  double depth = 0;   ///< of the deepest point below the start [m]
  double period = 1;  ///< from surface to surface [s]
};

/// Pitch with its derivative.
struct Dive {
  double pitch = 0;  ///< [rad]
  double rate = 0;   ///< [rad/s]
};

/// The largest vertical speed of a profile [m/s]: pi depth / period.
double steepest(const DepthProfile& profile);

/// The pitch at which a vehicle of a speed along its nose follows the profile: sin(pitch) = -depth'(t) /
/// speed. `speed` must exceed steepest(profile).
Dive dive(const DepthProfile& profile, double speed, double t);

}  // namespace canhil::world
