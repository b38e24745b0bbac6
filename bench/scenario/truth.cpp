#include "bench/scenario/truth.hpp"

#include <array>
#include <string>
#include <vector>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

world::Motion read_rest(Section& section) {
  return world::Rest{.angles = {.roll = section.number("roll_deg", Limits::between(-180, 180), 0),
                                .pitch = section.number("pitch_deg", Limits::between(-90, 90), 0),
                                .heading = section.number("heading_deg", Limits::between(-180, 360))}};
}

world::Motion read_level_acceleration(Section& section) {
  return world::LevelAcceleration{.heading = section.number("heading_deg", Limits::between(-180, 360)),
                                  .speed = section.number("speed_kmph", Limits::at_least(0)),
                                  .cruise_us = section.time_us("cruise_s", Limits::at_least(0)),
                                  .acceleration = section.number("acceleration_g", Limits::between(-10, 10))};
}

world::Motion read_weave(Section& section) {
  // Without a motion its period is of no consequence, but must not be zero.
  return world::Weave{
      .heading = section.number("heading_deg", Limits::between(-180, 360)),
      .speed = section.number("speed_kmph", Limits::at_least(0)),
      .heading_amplitude = section.number("heading_amplitude_deg", Limits::between(0, 90)),
      .turn_period = section.number("turn_period_s", Limits::above(0)),
      .pitch_amplitude = section.number("pitch_amplitude_deg", Limits::between(0, 45), 0),
      .pitch_period = section.number("pitch_period_s", Limits::above(0), 1),
      .coning_amplitude = section.number("coning_amplitude_deg", Limits::between(0, 5), 0),
      .coning_period = section.number("coning_period_ms", Limits::above(0), 1000),
  };
}

struct MotionReader {
  std::string_view name;
  world::Motion (*read)(Section&);
};
constexpr std::array motion_readers{MotionReader{"rest", read_rest},
                                    MotionReader{"level_acceleration", read_level_acceleration},
                                    MotionReader{"weave", read_weave}};

}  // namespace

world::Flight read_truth(Section& section) {
  world::Flight flight;
  // NED axes have no north at a pole, hence 89 degrees.
  flight.start = {.latitude = section.number("latitude_deg", Limits::between(-89, 89)),
                  .longitude = section.number("longitude_deg", Limits::between(-180, 180)),
                  .height = section.number("height_m", Limits::between(-1000, 50'000))};
  std::vector<std::string> names;
  for (const MotionReader& reader : motion_readers) names.emplace_back(reader.name);
  const std::string name = section.one_of("trajectory", names);
  for (const MotionReader& reader : motion_readers) {
    if (reader.name == name) flight.motion = reader.read(section);
  }
  section.finish();
  return flight;
}

}  // namespace canhil::scenario
