#include "bench/plant/engagement/read.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include "bench/plant/engagement/plan.hpp"
#include "bench/plant/setup.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/read_enum.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::plant::engagement {
namespace {

using scenario::Limits;
using scenario::read_enum;
using scenario::Section;

// A step or a weave begins at a given time or at a given time to go.
Manoeuvre read_manoeuvre(Section& section) {
  static constexpr std::array<std::string_view, 3> kinds{"none", "step", "weave"};
  Manoeuvre manoeuvre;
  manoeuvre.kind = read_enum<Manoeuvre::Kind>(
      section,
      {"manoeuvre", "Manoeuvre of the flight target in each plane. The sign of the acceleration is random."},
      kinds, Manoeuvre::Kind::step);
  if (manoeuvre.kind != Manoeuvre::Kind::weave)
    section.refuse("manoeuvre_period_s", "has no effect here", "manoeuvre = \"weave\"");
  if (manoeuvre.kind == Manoeuvre::Kind::none) {
    for (const char* key : {"manoeuvre_g", "manoeuvre_from_s", "manoeuvre_at_to_go_s"})
      section.refuse(key, "has no effect here", "manoeuvre = \"step\" or \"weave\"");
    manoeuvre.acceleration = 0;
    return manoeuvre;
  }
  manoeuvre.acceleration =
      section.number({"manoeuvre_g", "Acceleration of the manoeuvre."}, Limits::between(0, 20), 4);
  if (manoeuvre.kind == Manoeuvre::Kind::weave)
    manoeuvre.period =
        section.number({"manoeuvre_period_s", "Period of a weave."}, Limits::above(0), manoeuvre.period);
  const auto from_s = section.optional_number(
      {"manoeuvre_from_s", "Time at which the manoeuvre begins, in place of `manoeuvre_at_to_go_s`."},
      Limits::at_least(0));
  if (from_s && section.has("manoeuvre_at_to_go_s"))
    section.reject("manoeuvre_at_to_go_s", "is given beside manoeuvre_from_s", "one of the two");
  const double to_go =
      section.number({"manoeuvre_at_to_go_s",
                      "Time to go at which the manoeuvre begins, if `manoeuvre_from_s` is not given."},
                     Limits::above(0), 1);
  manoeuvre.from_s = from_s.value_or(0);
  manoeuvre.at_time_to_go = from_s ? std::nullopt : std::optional(to_go);
  return manoeuvre;
}

Settings read_settings(Section& section) {
  static constexpr std::array<std::string_view, 2> guidances{"truth", "target"};
  static constexpr std::array<std::string_view, 3> planes{"both", "pitch", "yaw"};
  const Limits sigma = Limits::at_least(0);
  Settings settings;
  settings.range = section.number(
      {"range_m", "Distance between missile and flight target at the start. They fly towards each other."},
      Limits::between(100, 26'000), 5000);
  settings.missile_speed =
      section.number({"missile_speed_mps", "Speed of the missile, constant."}, Limits::above(0, 3000), 600);
  settings.target_speed = section.number({"target_speed_mps", "Speed of the flight target, constant."},
                                         Limits::above(0, 1000), 300);
  settings.heading_error = section.number({"heading_error_deg",
                                           "Error of the missile's direction of flight at the start, in each "
                                           "plane that `planes` selects. The sign of the error is random."},
                                          Limits::between(-45, 45), 0);
  settings.heading_error_sigma = section.number(
      {"heading_error_sigma_deg",
       "1-sigma of a random heading error, drawn for each run and added to `heading_error_deg`."},
      Limits::between(0, 15), 3);
  settings.pointing_error_sigma =
      section.number({"pointing_error_sigma_mrad", "1-sigma of the antenna's pointing error at the start."},
                     Limits::between(0, 100), 5);
  settings.planes = read_enum<ActivePlanes>(
      section,
      {"planes",
       "Planes in which the missile has a heading error and in which the flight target makes its manoeuvre. "
       "The antenna has a pointing error in both planes."},
      planes, ActivePlanes::both);
  settings.manoeuvre = read_manoeuvre(section);
  settings.navigation_constant =
      section.number({"navigation_constant", "Navigation constant of the guidance law."}, sigma, 4);
  settings.autopilot_lag = section.number({"autopilot_lag_s", "Time constant of the missile's autopilot."},
                                          Limits::between(0.01, 10), 0.15);
  settings.acceleration_limit = section.number(
      {"acceleration_limit_g", "Largest acceleration of the missile."}, Limits::above(0, 100), 35);
  settings.servo_gain =
      section.number({"antenna_servo_per_s", "Gain of the antenna's servo."}, Limits::between(0, 200), 12);
  settings.roll_rate =
      section.number({"roll_rate_radps", "Roll rate of the missile."}, Limits::between(-20, 20), 0);
  settings.guidance = read_enum<Guidance>(
      section,
      {"guidance",
       "LOS rate that proportional navigation uses. `truth`: the true LOS rate; `target`: the LOS rate in "
       "the answers of the target under test, so the miss distance depends on the target and on the bus."},
      guidances);
  settings.guidance_delay_us = section.time_us(
      {"guidance_delay_ms",
       "Time from the transmission of a seeker sample to the guidance command that uses the answer to this "
       "sample. With `guidance` `target` this time must be at least 10 ms, the cycle time of Sync."},
      Limits::between(0, 1000), 10);
  if (settings.guidance == Guidance::truth)
    section.refuse("guidance_predicts", "has no effect here", "guidance = \"target\"");
  settings.guidance_predicts =
      section.flag({"guidance_predicts",
                    "If true, the LOS rate of the answer is extrapolated to the middle of the time for which "
                    "the guidance command is held. Only with `guidance` `target`."});
  section.finish();
  return settings;
}

constexpr std::array<std::string_view, 3> shows{"plant.range", "los.rate.pitch", "los.rate.yaw"};

scenario::PlantFacts read_engagement(Section& /*root*/, Section& section, const scenario::Binding& binding) {
  const Settings settings = read_settings(section);
  if (settings.guidance == Guidance::target && !binding.closes_loop)
    section.reject("guidance", "is 'target', but the mapping has no answers that guide the missile",
                   "'truth', or answers with los.rate.pitch and los.rate.yaw");
  return facts_of(settings);
}

}  // namespace

scenario::PlantFacts facts_of(const Settings& settings) {
  auto facts = plant::facts_of(table, std::make_shared<MissilePlan>(settings));
  facts.to_go_s = settings.range / (settings.missile_speed + settings.target_speed);
  facts.largest_roll_rate = std::abs(settings.roll_rate);
  if (settings.guidance == Guidance::target)
    facts.guidance = {.delay_us = settings.guidance_delay_us, .predicts = settings.guidance_predicts};
  return facts;
}

constinit const scenario::PlantTable table{
    .key = "engagement",
    .about =
        "A missile and its flight target, which is the object that the missile flies to. Random values "
        "are drawn for each run.",
    .shows = shows,
    .nodes_last = true,
    .read = read_engagement};

}  // namespace canhil::plant::engagement
