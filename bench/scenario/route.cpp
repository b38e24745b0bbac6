#include "bench/scenario/route.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>

#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

using world::Leg;
using world::LegPath;
using world::Vector3;
using world::units::deg;

constexpr double longest_route_s = 86'400;
constexpr double steepest_climb = 60 * deg;
constexpr double sharpest_turn = 170 * deg;

std::int64_t whole_us(double seconds) { return std::llround(1e6 * seconds); }
double as_seconds(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

/// The integral of a function of x over [0, 1].
template <class Function>
double mean_of(Function function) {
  return boost::math::quadrature::gauss<double, 30>::integrate(function, 0.0, 1.0);
}

/// A level turn at a corner.
struct Corner {
  Leg leg;                           ///< without a turn: of duration 0
  double before = 0;                 ///< from the beginning of the turn to the corner, and on to its end [m]
  Vector3 middle = Vector3::Zero();  ///< from the corner to the middle of the turn, NED [m]
};

Corner corner_of(const RoutePlan& plan, double course, double turn) {
  Corner corner{.leg = {.speed = plan.speed, .transition_us = plan.transition_us}};
  if (std::abs(turn) < 1e-9) return corner;
  corner.leg.turn = turn;
  corner.leg.turn_us =
      std::max(2 * plan.transition_us, whole_us(std::abs(turn) / plan.turn_rate) + plan.transition_us);
  corner.leg.duration_us = corner.leg.turn_us;
  const LegPath path(plan.carrier, plan.speed, 0, std::span(&corner.leg, 1));
  const double half = 0.5 * as_seconds(corner.leg.turn_us);
  const auto moved = [&](int axis) {
    constexpr int pieces = 8;
    double sum = 0;
    for (int piece = 0; piece < pieces; ++piece)
      sum += mean_of([&](double x) { return path.kinematics(half * (piece + x) / pieces).v_eb_n[axis]; });
    return half * sum / pieces;
  };
  const double ahead = moved(0), right = moved(1);  // of the course before, until the middle
  // The turn is symmetric about the bisector at its middle.
  corner.before = ahead + right * std::tan(0.5 * turn);
  const double s = std::sin(course), c = std::cos(course), along = ahead - corner.before;
  corner.middle = {along * c - right * s, along * s + right * c, 0};
  return corner;
}

/// The climb angle (rotorcraft: climb rate) and the duration of a straight line with a length over ground and
/// a gain of height; none: it is too short. The climb begins and ends within the transition.
struct Slope {
  double climb = 0;
  double duration = 0;
};
std::optional<Slope> slope_of(const RoutePlan& plan, double length, double gain) {
  if (std::abs(gain) < 1e-6) return Slope{.duration = length / plan.speed};
  const double transition = as_seconds(plan.transition_us), blends = 2 * transition * plan.speed;
  if (length < blends) return std::nullopt;
  if (plan.carrier.vehicle == world::Vehicle::rotorcraft) {
    const double duration = length / plan.speed;
    return Slope{.climb = gain / (duration - transition), .duration = duration};
  }
  const auto part = [&](double climb,
                        auto of) {  // the way in the blends: over ground (cos), or upwards (sin)
    return blends * mean_of([&](double x) { return of(climb * world::blend(0, 1, 1, x).value); });
  };
  const auto level = [&](double climb) { return part(climb, [](double angle) { return std::cos(angle); }); };
  // The gain of height grows with the angle.
  const auto missing = [&](double climb) {
    return part(climb, [](double angle) { return std::sin(angle); }) +
           (length - level(climb)) * std::tan(climb) - gain;
  };
  if (missing(-steepest_climb) > 0 || missing(steepest_climb) < 0) return std::nullopt;
  std::uintmax_t most_steps = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      missing, -steepest_climb, steepest_climb, boost::math::tools::eps_tolerance<double>(), most_steps);
  const double climb = 0.5 * (low + high);
  return Slope{.climb = climb,
               .duration = 2 * transition + (length - level(climb)) / (plan.speed * std::cos(climb))};
}

/// The legs in the plane, and what is needed to compare their flight with the waypoints.
struct Drawn {
  std::vector<Leg> legs;
  double heading = 0;
  std::vector<Corner> corners;         // at the waypoints; the last is no turn
  std::vector<std::int64_t> times_us;  // at the middles of the corners
};

class Drawing {
 public:
  Drawing(const RoutePlan& plan, std::span<const Vector3> points) : plan_(plan), points_(points) {}

  /// `points`: of the start and the waypoints, NED [m].
  tl::expected<Drawn, NoRoute> draw() {
    std::vector<double> lengths, courses;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Vector3 way = points_[i] - points_[i - 1];
      lengths.push_back(std::hypot(way.x(), way.y()));
      courses.push_back(std::atan2(way.y(), way.x()));
      if (lengths.back() < 1e-3)
        return refuse(i - 1, fmt::format("is at the same place as {}", name(i - 1)), "another place");
    }
    drawn_.heading = courses.front();
    if (plan_.rest_us > 0) add({.duration_us = plan_.rest_us});
    const double changing = 0.5 * plan_.speed * as_seconds(plan_.speed_us);  // way of a change of speed
    if (plan_.from_rest)
      add({.duration_us = plan_.speed_us, .speed = plan_.speed, .speed_us = plan_.speed_us});
    double taken = plan_.from_rest ? changing : 0;  // of the line, by what is before its straight part
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const bool last = i + 1 == lengths.size();
      const double turn = last ? 0 : world::wrapped(courses[i + 1] - courses[i]);
      if (std::abs(turn) > sharpest_turn)
        return refuse(i, fmt::format("needs a turn of {:.0f} deg", std::abs(turn) / deg),
                      fmt::format("at most {:.0f}", sharpest_turn / deg));
      Corner corner = corner_of(plan_, courses[i], turn);
      const double needed = taken + corner.before + (last && plan_.stops ? changing : 0);
      if (needed > lengths[i])
        return refuse(i,
                      fmt::format("is {:.6g} m from {}, but the turns and changes of speed between them need "
                                  "{:.6g} m",
                                  lengths[i], name(i), needed),
                      "a smaller turn radius or speed, or waypoints further apart");
      const double gain = points_[i].z() - points_[i + 1].z();
      if (!add_straight(lengths[i] - needed, gain))
        return tl::unexpected(NoRoute{
            .waypoint = i,
            .what = fmt::format("is {:.6g} m {} {}, on a straight line of {:.6g} m", std::abs(gain),
                                gain > 0 ? "above" : "below", name(i), lengths[i] - needed),
            .expected = fmt::format("a climb of at most {:.0f} deg on a line of at least {:.6g} m",
                                    steepest_climb / deg, 2 * plan_.speed * as_seconds(plan_.transition_us)),
            .height = true});
      if (last && plan_.stops) add({.duration_us = plan_.speed_us, .speed_us = plan_.speed_us});
      drawn_.times_us.push_back(time_us_ + corner.leg.turn_us / 2);
      if (corner.leg.duration_us > 0) add(corner.leg);
      taken = corner.before;
      drawn_.corners.push_back(corner);
      if (time_us_ > whole_us(longest_route_s))
        return refuse(i, "is reached after more than a day", "a shorter way or a higher speed");
    }
    return std::move(drawn_);
  }

 private:
  static tl::unexpected<NoRoute> refuse(std::size_t waypoint, std::string what, std::string expected) {
    return tl::unexpected(
        NoRoute{.waypoint = waypoint, .what = std::move(what), .expected = std::move(expected)});
  }
  static std::string name(std::size_t point) {
    return point == 0 ? "the start" : fmt::format("waypoint[{}]", point);
  }
  void add(Leg leg) {
    leg.transition_us = plan_.transition_us;
    time_us_ += leg.duration_us;
    drawn_.legs.push_back(leg);
  }
  bool add_straight(double length, double gain) {
    const auto slope = slope_of(plan_, length, gain);
    if (!slope) return false;
    const std::int64_t level_us = slope->climb == 0 ? 0 : plan_.transition_us;
    const std::int64_t duration_us = whole_us(std::min(slope->duration, longest_route_s + 1)) - level_us;
    if (duration_us > 0) add({.duration_us = duration_us, .speed = plan_.speed, .climb = slope->climb});
    if (level_us > 0) add({.duration_us = level_us, .speed = plan_.speed});
    return true;
  }

  const RoutePlan& plan_;
  std::span<const Vector3> points_;
  Drawn drawn_;
  std::int64_t time_us_ = 0;
};

/// The positions at some times, ascending, of a path on the ellipsoid.
std::vector<world::Position> flown(const LegPath& path, world::Position position, double turn_rate,
                                   std::span<const std::int64_t> times_us) {
  std::vector<std::int64_t> stops_us;
  std::ranges::merge(path.jumps_us(), times_us, std::back_inserter(stops_us));
  // A step of the fourth order turns by 0.05 rad at most.
  const double longest_step = std::min(5.0, 0.05 / turn_rate);
  std::vector<world::Position> positions;
  std::size_t wanted = 0;
  std::int64_t t_us = 0;
  for (const std::int64_t to_us : stops_us) {
    const double length = as_seconds(to_us - t_us);
    const int steps = length > 0 ? std::max(2, static_cast<int>(std::ceil(length / longest_step))) : 0;
    const double dt = steps > 0 ? length / steps : 0;
    for (int step = 0; step < steps; ++step) {
      const double t = as_seconds(t_us) + step * dt;
      const auto velocity = [&](double at) { return path.kinematics(at).v_eb_n; };
      position = world::advanced(position, velocity(t), velocity(t + 0.5 * dt), velocity(t + dt), dt);
    }
    t_us = to_us;
    for (; wanted < times_us.size() && times_us[wanted] == t_us; ++wanted) positions.push_back(position);
    if (wanted == times_us.size()) break;
  }
  return positions;
}

}  // namespace

tl::expected<Route, NoRoute> plan_route(const RoutePlan& plan, const world::Position& start,
                                        std::span<const world::Position> waypoints) {
  std::vector<Vector3> points{Vector3::Zero()};
  const world::Position* before = &start;
  for (const world::Position& waypoint : waypoints) {
    points.push_back(points.back() + world::displacement_n(*before, waypoint));
    before = &waypoint;
  }
  // Times are whole microseconds, so the way is rounded.
  const double within = std::max(1e-3, 2e-6 * plan.speed * static_cast<double>(waypoints.size()));
  constexpr int most_passes = 50;
  for (int pass = 0; pass < most_passes; ++pass) {
    auto drawn = Drawing(plan, points).draw();
    if (!drawn) return tl::unexpected(drawn.error());
    const LegPath path(plan.carrier, plan.from_rest ? 0 : plan.speed, drawn->heading, drawn->legs);
    const auto positions = flown(path, start, plan.turn_rate, drawn->times_us);
    double worst = 0;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      const world::Position reached = world::displaced(positions[i], -drawn->corners[i].middle);
      const Vector3 missed = world::displacement_n(reached, waypoints[i]);
      points[i + 1] += missed;
      worst = std::max(worst, missed.norm());
    }
    if (worst > within) continue;
    Route route{.legs = std::move(drawn->legs),
                .heading = drawn->heading,
                .passes = {},
                .times_us = std::move(drawn->times_us)};
    for (const Corner& corner : drawn->corners) route.passes.push_back(corner.middle.norm());
    return route;
  }
  return tl::unexpected(NoRoute{.waypoint = waypoints.size() - 1,
                                .what = "is not met by lines of constant course",
                                .expected = "waypoints that are less far apart"});
}

}  // namespace canhil::scenario
