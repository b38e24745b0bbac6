// A weave: coordinated S-turns with a slow pitching motion, optionally with a coning vibration. It starts
// with wings level on its heading.
#pragma once

#include "bench/world/kinematics.hpp"

namespace canhil::world {

struct Weave {
  double heading = 0;            ///< at the start [rad]
  double speed = 0;              ///< constant, along the path [m/s]
  double heading_amplitude = 0;  ///< heading swings between heading and heading + 2 amplitudes [rad]
  double turn_period = 1;        ///< [s]
  double pitch_amplitude = 0;    ///< [rad]
  double pitch_period = 1;       ///< [s]
  double coning_amplitude = 0;   ///< half-angle of the cone [rad]
  double coning_period = 1;      ///< [s]
};

Kinematics kinematics(const Weave& motion, double t);

}  // namespace canhil::world
