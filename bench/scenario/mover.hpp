// What the trajectories "legs" and "waypoints" have in common: the vehicle, its limits, and how it turns.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "bench/scenario/quantity.hpp"
#include "bench/world/motion/leg_path.hpp"

namespace canhil::scenario {

class Section;

/// In the order of world::Vehicle.
inline constexpr std::array<std::string_view, 5> vehicle_names{"car", "ship", "auv", "aircraft",
                                                               "rotorcraft"};

/// Limits of the time of a change [s].
inline constexpr Limits transition_limits{.least = 0.01, .most = 1000};

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

}  // namespace canhil::scenario
