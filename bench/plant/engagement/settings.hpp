// The settings of an engagement: a missile flies by proportional navigation at a target that may manoeuvre,
// and the antenna of its seeker follows the line of sight. By default, missile and target fly towards each
// other from a distance of 5 km, with a closing speed of 900 m/s.
//
// The axes n do not rotate: x is along the line of sight at the start, y to the right, z down. Gravity is
// omitted, because gravity acts on missile and target alike. The axes a are those of the antenna: x forward,
// y to the right, z down.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/world/planes.hpp"
#include "bench/world/units.hpp"

namespace canhil::plant::engagement {

namespace units = world::units;

/// The acceleration of the target, which is perpendicular to the target's velocity. For each run, the sign of
/// the acceleration in each plane is drawn.
struct Manoeuvre {
  enum class Kind : std::uint8_t { none, step, weave };
  Kind kind = Kind::step;
  double acceleration = 4 * units::standard_gravity;  ///< amplitude of a weave [m/s^2]
  double period = 2;                                  ///< period of a weave [s]; its phase is drawn
  double from_s = 0;                        ///< start of the manoeuvre, if there is no at_time_to_go
  std::optional<double> at_time_to_go = 1;  ///< start when range over closing speed falls to this value [s]
};

/// The source of the LOS rate for the guidance: the truth, or the answers of the device under test
/// (`target`).
enum class Guidance : std::uint8_t { truth, target };
/// The planes in which heading error and manoeuvre act. Noise always acts in both planes.
enum class ActivePlanes : std::uint8_t { both, pitch, yaw };

struct Settings {
  double range = 5000;         ///< at the start [m]
  double missile_speed = 600;  ///< constant [m/s]
  double target_speed = 300;   ///< constant, towards the missile [m/s]
  double heading_error = 0;    ///< angle of the missile's velocity to the line of sight in each plane [rad]
  double heading_error_sigma = 3 * units::deg;    ///< drawn in each plane [rad]
  double pointing_error_sigma = 5 * units::mrad;  ///< initial antenna error, drawn in each plane [rad]
  ActivePlanes planes = ActivePlanes::both;
  Manoeuvre manoeuvre{};

  double navigation_constant = 4;
  double autopilot_lag = 0.15;                               ///< first order [s]
  double acceleration_limit = 35 * units::standard_gravity;  ///< limit of the commanded acceleration [m/s^2]
  double servo_gain = 12;                                    ///< antenna rate per error angle [1/s]
  double roll_rate = 0;                                      ///< roll rate of the antenna [rad/s]
  Guidance guidance = Guidance::truth;
  std::int64_t guidance_delay_us = 10'000;  ///< from sending a sample to the command that uses its answer
  bool guidance_predicts = false;           ///< extrapolates the answer to the time of the command
};

}  // namespace canhil::plant::engagement
