#include "bench/scenario/mover.hpp"

#include <cmath>

#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {

using world::Vehicle;
using world::units::standard_gravity;

void refuse_backward(Section& section, const Mover& mover, double speed) {
  const Vehicle vehicle = mover.carrier.vehicle;
  if (speed < 0 && (vehicle == Vehicle::aircraft || vehicle == Vehicle::rotorcraft))
    section.reject("speed_mps", "is negative",
                   vehicle == Vehicle::aircraft ? "at least 0" : "at least 0, and drift_deg = 180");
}

std::optional<double> read_turn_rate(Section& section, double over_ground) {
  const auto rate = section.optional_number({"turn_rate_degps",
                                             "Turn rate in the middle of a turn, positive to the right. If "
                                             "the angle of the turn is given, only the "
                                             "magnitude counts."},
                                            Limits::between(-360, 360));
  if (rate) section.refuse("turn_radius_m", "is given beside turn_rate_degps", "one of the two");
  const auto radius = section.optional_number(
      {"turn_radius_m",
       "Radius in the middle of a turn, at the speed of the leg; sign as `turn_rate_degps`."},
      Limits::between(-1e6, 1e6));
  if (rate || radius)
    section.refuse("bank_deg", "is given beside another rate of the turn", "one of the two");
  const auto bank = section.optional_number(
      {"bank_deg",
       "Bank angle in the middle of a coordinated turn, at the speed of the leg; sign as `turn_rate_degps`. "
       "Only for `aircraft` and `rotorcraft`."},
      Limits::between(-80, 80));
  if (rate) return rate;
  if (!radius && !bank) return std::nullopt;
  const std::string_view key = radius ? "turn_radius_m" : "bank_deg";
  const double speed = std::abs(over_ground);
  if (speed == 0) section.reject(key, "has no effect at the speed 0", "turn_rate_degps");
  if (radius && std::abs(*radius) < 1e-3) section.reject(key, "is 0", "a radius");
  if (section.error() || speed == 0) return std::nullopt;
  return radius ? speed / *radius : standard_gravity * std::tan(*bank) / speed;
}

Mover read_mover(Section& section) {
  Mover mover;
  mover.carrier.vehicle = read_enum<Vehicle>(section,
                                             {"vehicle",
                                              "How the attitude follows the motion. `car`, `ship`, `auv`: "
                                              "the nose is along the path; `aircraft`: it "
                                              "banks in turns, coordinated; `rotorcraft`: it tilts by its "
                                              "acceleration, and may move in any direction."},
                                             vehicle_names);
  const Vehicle vehicle = mover.carrier.vehicle;
  mover.transition_us =
      section.time_us({"transition_s",
                       "Time within which speed, climb and drift change, and a turn begins and ends. The "
                       "changes are smooth: accelerations and rates have continuous derivatives."},
                      transition_limits, 2);
  if (vehicle != Vehicle::aircraft)
    section.refuse("angle_of_attack_deg", "has no effect on this vehicle", "vehicle = \"aircraft\"");
  mover.carrier.angle_of_attack = section.number(
      {"angle_of_attack_deg", "`aircraft`: pitch minus climb angle, constant."}, Limits::between(-20, 30), 0);
  if (vehicle == Vehicle::aircraft || vehicle == Vehicle::rotorcraft)
    section.refuse("roll_per_g_deg", "has no effect on this vehicle",
                   "vehicle = \"car\", \"ship\" or \"auv\"");
  mover.carrier.roll_by_acceleration =
      section.number({"roll_per_g_deg",
                      "`car`, `ship`, `auv`: outward roll in a turn with a lateral acceleration of 1 g; the "
                      "roll is proportional to the acceleration."},
                     Limits::between(-90, 90), 0) /
      standard_gravity;
  return mover;
}

}  // namespace canhil::scenario
