// Reads the trajectories "legs" and "waypoints" of [truth]: the vehicle, and what it does on each
// [[truth.leg]], or the [[truth.waypoint]]s by which it passes.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/scenario/quantity.hpp"
#include "bench/world/motion.hpp"
#include "bench/world/motion/leg_path.hpp"

namespace canhil::scenario {

class Section;

/// The vehicle, and the time within which its changes happen.
struct Mover {
  world::Carrier carrier;
  std::int64_t transition_us = 0;
};

/// Limits of a speed of legs and waypoints [m/s].
inline constexpr Limits speed_limits{.least = -1000, .most = 3000};

/// Reads vehicle, transition_s, angle_of_attack_deg and roll_per_g_deg.
Mover read_mover(Section& section);

/// Reads the rate of a turn, signed [rad/s]: turn_rate_degps, or turn_radius_m or bank_deg at a speed over
/// ground [m/s]; none: no such key is given.
std::optional<double> read_turn_rate(Section& section, double over_ground);

/// Rejects speed_mps if it is negative and the vehicle has no reverse.
void refuse_backward(Section& section, const Mover& mover, double speed);

/// Reads the vehicle, its speed and the waypoints, for a flight that begins at `start`.
world::Motion read_waypoints(Section& section, const world::Position& start);

/// Reads the vehicle, the state at the start and the legs.
world::Motion read_legs(Section& section);

}  // namespace canhil::scenario
