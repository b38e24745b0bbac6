// A motion made of legs. On each leg the vehicle changes to a new speed, climb and drift, and may turn; then
// it holds them until the leg ends. A turn begins and ends within its leg. After the last leg the motion goes
// on with the last values.
//
// All changes are blends (blend.hpp), so the acceleration and the angular rate are continuous with their
// first derivatives.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/world/kinematics.hpp"
#include "bench/world/motion/blend.hpp"

namespace canhil::world {

/// How the attitude follows the motion.
///
/// car, ship, auv: the heading is the course, the pitch is the climb angle; the roll is outward, proportional
/// to the lateral acceleration. aircraft: the bank of a coordinated turn, tan(roll) = v turn rate / g; the
/// pitch is the climb angle plus the angle of attack. rotorcraft: the course is the heading plus the drift
/// angle; the body z axis points against the specific force (the thrust carries the weight and accelerates).
enum class Vehicle : std::uint8_t { car, ship, auv, aircraft, rotorcraft };

struct Carrier {
  Vehicle vehicle = Vehicle::car;
  double angle_of_attack = 0;       ///< aircraft [rad]
  double roll_by_acceleration = 0;  ///< car, ship, auv: outward roll by lateral acceleration [rad/(m/s^2)]
};

/// What is reached on a leg. Each change begins when the leg begins.
struct Leg {
  std::int64_t duration_us = 0;
  double speed = 0;                ///< at the end, along the path; rotorcraft: over ground [m/s]
  double climb = 0;                ///< at the end, climb angle [rad]; rotorcraft: climb rate [m/s]
  double drift = 0;                ///< at the end, course minus heading; rotorcraft only [rad]
  double turn = 0;                 ///< change of the heading, positive to the right [rad]
  std::int64_t speed_us = 0;       ///< time of the change of speed, <= duration_us
  std::int64_t transition_us = 0;  ///< time of the changes of climb and drift, and of each end of a turn
  std::int64_t turn_us = 0;        ///< time of the turn with both its ends, <= duration_us
};

class LegPath {
 public:
  /// `speed`, `heading`: at the start [m/s, rad]. The climb and the drift are zero at the start.
  LegPath(const Carrier& carrier, double speed, double heading, std::span<const Leg> legs);

  [[nodiscard]] Kinematics kinematics(double t) const;
  /// The times at which a blend begins or ends, and times that divide each blend, ascending [us].
  [[nodiscard]] std::span<const std::int64_t> jumps_us() const { return jumps_us_; }

 private:
  /// A leg with the values at its beginning, in seconds.
  struct Stretch {
    double from = 0;  ///< time of the run [s]
    double speed_before = 0, climb_before = 0, drift_before = 0, heading_before = 0;
    double speed = 0, climb = 0, drift = 0, turn = 0;
    double speed_time = 0, transition = 0, turn_time = 0, turn_transition = 0;  ///< [s]
  };
  /// What a leg prescribes at one instant.
  struct Course {
    Changing speed, climb, drift, heading;
  };
  void add_blend(std::int64_t from_us, std::int64_t length_us);
  [[nodiscard]] static Course course(const Stretch& stretch, double tau);
  [[nodiscard]] Kinematics along_the_path(const Course& now) const;

  Carrier carrier_;
  std::vector<Stretch> stretches_;  // the first begins at 0, at the start's values
  std::vector<std::int64_t> jumps_us_;
};

}  // namespace canhil::world
