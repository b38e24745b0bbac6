// Plans legs from waypoints: straight lines of constant course (rhumb lines), joined by turns that pass the
// waypoints on the inside (fly-by). The last waypoint is reached.
//
// The legs are planned in a plane and flown on the ellipsoid; then the points of the plane are moved by the
// distances by which the flight missed the waypoints, until it meets them to a few millimetres.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "bench/world/earth.hpp"
#include "bench/world/motion/leg_path.hpp"

namespace canhil::scenario {

struct RoutePlan {
  world::Carrier carrier;
  double speed = 1;                ///< along the path; rotorcraft: over ground [m/s]
  double turn_rate = 0;            ///< in the middle of a turn, above 0 [rad/s]
  std::int64_t transition_us = 0;  ///< > 0
  std::int64_t speed_us = 0;       ///< time from rest to the speed, and back
  std::int64_t rest_us = 0;        ///< time at rest at the start
  bool from_rest = false;
  bool stops = false;  ///< at the last waypoint
};

struct Route {
  std::vector<world::Leg> legs;
  double heading = 0;                  ///< at the start [rad]
  std::vector<double> passes;          ///< distance at which each waypoint is passed [m]
  std::vector<std::int64_t> times_us;  ///< when it is passed
};

/// Why there is no route: what is wrong with a waypoint, counted from 0.
struct NoRoute {
  std::size_t waypoint = 0;
  std::string what, expected;
  bool height = false;  ///< the height is wrong, not the place
};

/// There must be at least one waypoint.
tl::expected<Route, NoRoute> plan_route(const RoutePlan& plan, const world::Position& start,
                                        std::span<const world::Position> waypoints);

}  // namespace canhil::scenario
