#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "bench/scenario/legs.hpp"
#include "bench/scenario/mover.hpp"
#include "bench/scenario/route.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

using world::Position;

/// `before`: the waypoint before, or the start.
Position read_waypoint(Section& section, const Position& start, const Position& before, bool climbs) {
  const bool geodetic = section.has("latitude_deg") || section.has("longitude_deg");
  constexpr std::string_view one_kind = "either latitude_deg, longitude_deg or north_m, east_m";
  if (geodetic) {
    for (const char* key : {"north_m", "east_m", "up_m"})
      section.refuse(key, "is given beside latitude_deg, longitude_deg", one_kind);
  } else {
    section.refuse("height_m", "is given without latitude_deg and longitude_deg", "up_m");
  }
  for (const char* key : {"height_m", "up_m"})
    if (!climbs) section.refuse(key, "has no effect on a vehicle \"ship\"", "no such key");
  if (geodetic) {
    const Position there{
        .latitude =
            section.number({"latitude_deg", "Latitude, in place of `north_m`."}, Limits::between(-89, 89)),
        .longitude =
            section.number({"longitude_deg", "Longitude, in place of `east_m`."}, Limits::between(-180, 180)),
        .height = section
                      .optional_number({"height_m",
                                        "Height above the ellipsoid, beside `latitude_deg` and "
                                        "`longitude_deg`. Default: that of the waypoint before."},
                                       Limits::between(-1000, 50'000))
                      .value_or(before.height)};
    return there;
  }
  const Limits way = Limits::between(-1e6, 1e6);
  const double north = section.number({"north_m", "Way to the north from the start."}, way);
  const double east = section.number({"east_m", "Way to the east from the start."}, way);
  const auto up =
      section.optional_number({"up_m", "Height above the start. Default: that of the waypoint before."},
                              Limits::between(-20'000, 50'000));
  Position there = world::displaced(start, {north, east, 0});
  there.height = up ? start.height + *up : before.height;
  return there;
}

/// Rejects the place or the height of a waypoint.
void reject(Section& section, bool height, std::string_view what, std::string_view expected) {
  const bool geodetic = section.has("latitude_deg");
  section.reject(height ? (geodetic ? "height_m" : "up_m") : (geodetic ? "latitude_deg" : "north_m"), what,
                 expected);
}

}  // namespace

world::Motion read_waypoints(Section& section, const Position& start) {
  const Mover mover = read_mover(section);
  const double speed = section.number({"speed_mps", "Speed. `legs`: at the start; `waypoints`: constant."},
                                      Limits::above(0, 3000));
  RoutePlan plan{.carrier = mover.carrier, .speed = speed, .transition_us = mover.transition_us};
  const auto rest_us = section.optional_time_us(
      {"rest_s",
       "`waypoints`: time at rest at the start; without this key, the vehicle starts at its speed."},
      Limits::between(0, 86'400));
  plan.from_rest = rest_us.has_value();
  plan.rest_us = rest_us.value_or(0);
  plan.stops =
      section.flag({"stop", "The vehicle comes to rest at the last waypoint; otherwise it moves on."});
  if (!plan.from_rest && !plan.stops)
    section.refuse("acceleration_mps2", "has no effect here", "rest_s or stop beside it");
  const auto acceleration = section.optional_number(
      {"acceleration_mps2",
       "`waypoints`: greatest acceleration from rest and to rest. Default: the speed changes within "
       "`transition_s`."},
      Limits::above(0, 1000));
  plan.speed_us = acceleration && *acceleration > 0
                      ? std::llround(1e6 * world::blend_peak * speed / *acceleration)
                      : mover.transition_us;
  const auto rate = read_turn_rate(section, speed);
  const auto within = section.optional_number(
      {"within_m",
       "Greatest distance at which a waypoint may be passed. A route with a greater one is refused."},
      Limits::above(0));
  std::vector<Section> sections = section.tables("waypoint");
  if (sections.size() > 1 && !rate)
    section.missing("turn_radius_m", "it, turn_rate_degps or bank_deg: how the vehicle turns at a waypoint");
  std::vector<Position> waypoints;
  for (Section& one : sections) {
    waypoints.push_back(read_waypoint(one, start, waypoints.empty() ? start : waypoints.back(),
                                      mover.carrier.vehicle != world::Vehicle::ship));
    one.finish();
  }
  if (section.error() || waypoints.empty() || !(speed > 0) || (sections.size() > 1 && !rate))
    return world::Rest{};
  plan.turn_rate = std::abs(rate.value_or(1));
  if (plan.turn_rate == 0) {
    section.reject(section.has("bank_deg") ? "bank_deg" : "turn_rate_degps", "is 0", "a turn");
    return world::Rest{};
  }
  const auto route = plan_route(plan, start, waypoints);
  if (!route) {
    const NoRoute& no = route.error();
    reject(sections[no.waypoint], no.height, no.what, no.expected);
    return world::Rest{};
  }
  for (std::size_t i = 0; within && i < waypoints.size(); ++i) {
    if (route->passes[i] > *within)
      reject(sections[i], false, fmt::format("is passed at {:.4g} m", route->passes[i]),
             fmt::format("at most within_m = {:g}, by a smaller turn radius", *within));
  }
  return world::Legs{std::make_shared<const world::LegPath>(mover.carrier, plan.from_rest ? 0 : speed,
                                                            route->heading, route->legs)};
}

}  // namespace canhil::scenario
