#include "bench/scenario/legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/scenario/mover.hpp"
#include "bench/scenario/section.hpp"
#include "bench/scenario/truth.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

using world::Leg;
using world::Vehicle;
using world::units::standard_gravity;

constexpr double longest_leg_s = 86'400;

double seconds_of(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }
std::int64_t us_of(double seconds) { return std::llround(1e6 * std::min(seconds, longest_leg_s)); }

/// Reads the legs one after another: what a leg does not give keeps the value of the leg before.
class LegReader {
 public:
  LegReader(const Mover& mover, double speed, double heading)
      : mover_(mover), heading_(heading), before_{.speed = speed} {}

  Leg read(Section& section) {
    Leg leg = before_;
    leg.transition_us =
        section
            .optional_time_us(
                {"transition_s", "Time of the changes of this leg, in place of that of [truth]."},
                transition_limits)
            .value_or(mover_.transition_us);
    read_speed(section, leg);
    read_climb(section, leg);
    read_drift(section, leg);
    const Turn turn = read_turn(section, leg);
    read_duration(section, leg, turn);
    section.finish();
    heading_ += leg.turn;
    before_ = leg;
    return leg;
  }

 private:
  /// A turn as the file gives it.
  struct Turn {
    std::optional<double> angle;  ///< [rad]
    std::optional<double> rate;   ///< [rad/s]
  };

  [[nodiscard]] bool is(Vehicle vehicle) const { return mover_.carrier.vehicle == vehicle; }
  [[nodiscard]] std::string name() const {
    return std::string(vehicle_names[static_cast<std::size_t>(mover_.carrier.vehicle)]);
  }
  void only_for(Section& section, std::string_view key, bool fits, std::string_view vehicles) const {
    if (!fits) section.refuse(key, fmt::format("has no effect on a vehicle \"{}\"", name()), vehicles);
  }
  [[nodiscard]] double over_ground(const Leg& leg) const {
    return is(Vehicle::rotorcraft) ? leg.speed : leg.speed * std::cos(leg.climb);
  }

  void read_speed(Section& section, Leg& leg) const {
    const auto speed = section.optional_number(
        {"speed_mps",
         "Speed at the end of the leg, along the path; `rotorcraft`: over ground. 0: the vehicle stops or is "
         "at "
         "rest. Negative: `car`, `ship` and `auv` move backward. Default: that of the leg before."},
        speed_limits);
    if (!speed) section.refuse("acceleration_mps2", "has no effect alone", "speed_mps beside it");
    const auto acceleration = section.optional_number(
        {"acceleration_mps2",
         "Greatest acceleration while the speed changes; the mean is 16/35 of it. Default: the speed changes "
         "within `transition_s`."},
        Limits::above(0, 1000));
    leg.speed = speed.value_or(before_.speed);
    refuse_backward(section, mover_, leg.speed);
    leg.speed_us = 0;
    if (leg.speed == before_.speed) return;
    leg.speed_us = leg.transition_us;
    if (!acceleration || *acceleration <= 0) return;
    const double time = world::blend_peak * std::abs(leg.speed - before_.speed) / *acceleration;
    leg.speed_us = us_of(time);
    if (time < transition_limits.least || time > longest_leg_s)
      section.reject("acceleration_mps2", fmt::format("changes the speed within {:.4g} s", time),
                     fmt::format("{:g} to {:g} s", transition_limits.least, longest_leg_s));
  }

  void read_climb(Section& section, Leg& leg) const {
    only_for(section, "climb_rate_mps", !is(Vehicle::ship), "no such key");
    only_for(section, "climb_angle_deg", !is(Vehicle::ship) && !is(Vehicle::rotorcraft), "no such key");
    const auto rate = section.optional_number(
        {"climb_rate_mps", "Climb rate at the end of the leg, negative: down. Not for a `ship`."},
        Limits::between(-300, 300));
    if (rate) section.refuse("climb_angle_deg", "is given beside climb_rate_mps", "one of the two");
    const auto angle = section.optional_number({"climb_angle_deg",
                                                "Climb angle at the end of the leg, in place of "
                                                "`climb_rate_mps`. `car`, `auv`, `aircraft`. Default: "
                                                "that of the leg before (`rotorcraft`: the climb rate)."},
                                               Limits::between(-80, 80));
    if (angle) leg.climb = *angle;
    if (!rate) return;
    if (is(Vehicle::rotorcraft)) {
      leg.climb = *rate;
      const double fall = world::blend_peak * (before_.climb - leg.climb);
      const double least = fall / (0.9 * standard_gravity);
      if (least > seconds_of(leg.transition_us))
        section.reject("climb_rate_mps", "falls with almost 1 g or more, which no rotor holds upright",
                       fmt::format("transition_s of at least {:.3g}", least));
      return;
    }
    constexpr double steepest = 0.98;  // sine of 80 deg
    if (std::abs(*rate) > steepest * std::abs(leg.speed))
      section.reject("climb_rate_mps", fmt::format("is too steep for {:g} m/s along the path", leg.speed),
                     fmt::format("at most {:.4g}", steepest * std::abs(leg.speed)));
    else
      leg.climb = *rate == 0 ? 0 : std::asin(*rate / leg.speed);
  }

  void read_drift(Section& section, Leg& leg) const {
    only_for(section, "drift_deg", is(Vehicle::rotorcraft), "vehicle = \"rotorcraft\"");
    const auto drift = section.optional_number(
        {"drift_deg",
         "Drift angle at the end of the leg: course minus heading; 90: to the right, 180: backward. It "
         "changes "
         "with the turn if there is one, otherwise within `transition_s`. Only for a `rotorcraft`. Default: "
         "that of the leg before."},
        Limits::between(-180, 180));
    if (drift) leg.drift = before_.drift + world::wrapped(*drift - before_.drift);
  }

  Turn read_turn(Section& section, const Leg& leg) const {
    Turn turn;
    turn.angle = section.optional_number({"turn_deg", "Change of the heading, positive to the right."},
                                         Limits::between(-36'000, 36'000));
    if (turn.angle) section.refuse("heading_deg", "is given beside turn_deg", "one of the two");
    const auto heading = section.optional_number(
        {"heading_deg", "Heading to turn to, by the shorter way; in place of `turn_deg`."},
        Limits::between(-180, 360));
    if (heading) turn.angle = world::wrapped(*heading - heading_);
    only_for(section, "bank_deg", is(Vehicle::aircraft) || is(Vehicle::rotorcraft),
             "vehicle = \"aircraft\" or \"rotorcraft\"");
    turn.rate = read_turn_rate(section, over_ground(leg));
    if (turn.angle && turn.rate && *turn.rate == 0) turn.rate.reset();
    return turn;
  }

  void read_duration(Section& section, Leg& leg, const Turn& turn) const {
    const std::int64_t ends_us = leg.transition_us;
    const bool other = leg.climb != before_.climb || leg.drift != before_.drift;
    std::int64_t least_us = std::max(leg.speed_us, other ? leg.transition_us : 0);
    leg.turn_us = 0;
    leg.turn = turn.angle.value_or(0);
    if (leg.turn != 0 && !turn.rate) leg.turn_us = 2 * us_of(transition_limits.least);
    if (leg.turn != 0 && turn.rate)
      leg.turn_us = std::max(2 * ends_us, us_of(std::abs(leg.turn / *turn.rate)) + ends_us);
    if (!turn.angle && turn.rate && *turn.rate != 0) leg.turn_us = 2 * ends_us;
    least_us = std::max(least_us, leg.turn_us);

    const auto duration_us =
        section.optional_time_us({"duration_s",
                                  "Duration of the leg. Without `duration_s` and `distance_m`, the leg ends "
                                  "when its changes are complete."},
                                 Limits::above(0, longest_leg_s));
    if (duration_us) section.refuse("distance_m", "is given beside duration_s", "one of the two");
    const auto distance = section.optional_number(
        {"distance_m",
         "Length of the leg along the path (`rotorcraft`: over ground), in place of `duration_s`."},
        Limits::above(0));
    std::string_view key = "duration_s";
    leg.duration_us = duration_us.value_or(least_us);
    if (distance) {
      key = "distance_m";
      leg.duration_us = time_of(section, leg, *distance);
    }
    const bool open = (leg.turn != 0 && !turn.rate) || (!turn.angle && turn.rate && *turn.rate != 0);
    if (!duration_us && !distance && (open || least_us == 0)) {
      section.reject(key, "is missing",
                     leg.turn != 0 ? "it, or turn_rate_degps, turn_radius_m or bank_deg: how fast to turn"
                     : open        ? "it, or turn_deg: how far to turn"
                                   : "it, or distance_m, or a change");
    } else if (leg.duration_us < least_us) {
      section.reject(
          key,
          fmt::format("lasts {:g} s, but the changes of the leg last longer", seconds_of(leg.duration_us)),
          fmt::format("at least {:g} s", seconds_of(least_us)));
    }
    if (open) leg.turn_us = leg.duration_us;
    if (!turn.angle && open) leg.turn = *turn.rate * seconds_of(leg.duration_us - ends_us);
  }

  std::int64_t time_of(Section& section, const Leg& leg, double distance) const {
    if (leg.speed == 0) {
      section.reject("distance_m", "is never reached, as the speed is 0 at the end of the leg", "duration_s");
      return 0;
    }
    const double changing = seconds_of(leg.speed_us);
    const double covered = 0.5 * (before_.speed + leg.speed) * changing;
    const double time = changing + (std::copysign(distance, leg.speed) - covered) / leg.speed;
    if (time > longest_leg_s)
      section.reject("distance_m", fmt::format("takes {:.4g} s", time),
                     fmt::format("at most {:g} s", longest_leg_s));
    if (time < changing)
      section.reject("distance_m", "is covered before the speed is reached",
                     fmt::format("at least {:.4g}", std::abs(covered)));
    return us_of(std::max(time, changing));
  }

  const Mover& mover_;
  double heading_;
  Leg before_;
};

}  // namespace

world::Motion read_legs(Section& section) {
  const Mover mover = read_mover(section);
  const double speed =
      section.number({"speed_mps", "Speed. `legs`: at the start; `waypoints`: constant."}, speed_limits, 0);
  refuse_backward(section, mover, speed);
  const double heading = read_heading(section);
  LegReader reader(mover, speed, heading);
  std::vector<Leg> legs;
  for (Section& leg : section.tables("leg")) legs.push_back(reader.read(leg));
  if (section.error()) return world::Rest{};
  return world::Legs{std::make_shared<const world::LegPath>(mover.carrier, speed, heading, legs)};
}

}  // namespace canhil::scenario
