#include "bench/scenario/truth.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/scenario/legs.hpp"
#include "bench/scenario/oscillations.hpp"
#include "bench/scenario/recorded_flight.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

world::Motion read_rest(Section& section) {
  return world::Rest{
      .angles = {
          .roll = section.number(
              {"roll_deg",
               "Roll angle. `rest`: constant; `unknown`: the initial value that the target receives."},
              Limits::between(-180, 180), 0),
          .pitch = section.number(
              {"pitch_deg",
               "Pitch angle. `rest`: constant; `unknown`: the initial value that the target receives."},
              Limits::between(-90, 90), 0),
          .heading = read_heading(section)}};
}

world::Motion read_level_acceleration(Section& section) {
  return world::LevelAcceleration{
      .heading = read_heading(section),
      .speed = section.number({"speed_kmph", "Speed. `level_acceleration`: at the start; `weave`: constant."},
                              Limits::at_least(0)),
      .cruise_us = section.time_us({"cruise_s", "Time at constant velocity before the acceleration begins."},
                                   Limits::at_least(0)),
      .acceleration = section.number({"acceleration_g", "Acceleration along the heading after `cruise_s`."},
                                     Limits::between(-10, 10))};
}

world::Motion read_weave(Section& section) {
  // If an amplitude is 0, its period has no effect, but the period must not be 0.
  return world::Weave{
      .heading = read_heading(section),
      .speed = section.number({"speed_kmph", "Speed. `level_acceleration`: at the start; `weave`: constant."},
                              Limits::at_least(0)),
      .heading_amplitude =
          section.number({"heading_amplitude_deg", "Amplitude of the heading."}, Limits::between(0, 90)),
      .turn_period = section.number(
          {"turn_period_s", "Period of the turns. `spiral`: time of a full turn to the right."},
          Limits::above(0)),
      .pitch_amplitude =
          section.number({"pitch_amplitude_deg", "Amplitude of the pitch."}, Limits::between(0, 45), 0),
      .pitch_period = section.number({"pitch_period_s", "Period of the pitch."}, Limits::above(0), 1),
      .coning_amplitude =
          section.number({"coning_amplitude_deg", "Amplitude of a coning motion."}, Limits::between(0, 5), 0),
      .coning_period =
          section.number({"coning_period_ms", "Period of the coning motion."}, Limits::above(0), 1000),
  };
}

// The vehicle dives and surfaces repeatedly. If the depth is 0, the period has no effect.
world::DepthProfile read_depth(Section& section, double speed) {
  const world::DepthProfile profile{
      .depth = section.number({"dive_depth_m",
                               "The vehicle dives to this depth below the start once in each "
                               "`dive_period_s`. The dive must not be steeper than 45 degrees."},
                              Limits::at_least(0), 0),
      .period = section.number({"dive_period_s", "Period of the dives. Only together with `dive_depth_m`."},
                               Limits::above(0), 1)};
  for (const auto& [key, other] :
       {std::pair{"dive_depth_m", "dive_period_s"}, std::pair{"dive_period_s", "dive_depth_m"}}) {
    if (section.has(key) && !section.has(other))
      section.reject(key, "is given alone", fmt::format("{} beside it", other));
  }
  constexpr double steepest_sine = 0.70710678118654752;  // 45 degrees
  if (world::steepest(profile) > steepest_sine * speed) {
    section.reject("dive_depth_m", "is too deep for the speed and dive_period_s",
                   fmt::format("at most {:.4g}, a dive of 45 degrees",
                               steepest_sine * speed * profile.period / std::numbers::pi));
  }
  return profile;
}

double read_roll(Section& section, const Key& key) {
  return section.number(key, Limits::between(-45, 45), 0);
}

world::Motion read_s_path(Section& section) {
  world::SPath path;
  path.speed = section.number({"speed_mps",
                               "Speed along the vehicle's forward axis. `rest_then_go`: full speed, reached "
                               "at the end of `start_s`; other trajectories: constant."},
                              Limits::above(0));
  path.heading = read_heading(section);
  path.heading_amplitude = section.number(
      {"heading_amplitude_deg", "Amplitude of the heading; 0: a straight path."}, Limits::between(0, 180));
  path.heading_period =
      section.number({"turn_period_s", "Period of the turns. `spiral`: time of a full turn to the right."},
                     Limits::above(0));
  path.pitch_amplitude =
      section.number({"pitch_amplitude_deg", "Amplitude of the pitch."}, Limits::between(0, 40), 0);
  path.pitch_period = section.number({"pitch_period_s", "Period of the pitch."}, Limits::above(0), 1);
  path.roll_amplitude = read_roll(section, {"roll_amplitude_deg", "Amplitude of the roll."});
  path.roll_period = section.number({"roll_period_s", "Period of the roll. Default: `turn_period_s`."},
                                    Limits::above(0), path.heading_period);
  path.depth = read_depth(section, path.speed);
  return path;
}

world::Motion read_racetrack(Section& section) {
  world::Racetrack track;
  track.speed = section.number({"speed_mps",
                                "Speed along the vehicle's forward axis. `rest_then_go`: full speed, reached "
                                "at the end of `start_s`; other trajectories: constant."},
                               Limits::above(0));
  track.heading = read_heading(section);
  track.leg = section.number({"leg_s", "Duration of a straight leg."}, Limits::above(0));
  track.turn = section.number({"turn_s", "Duration of a half turn to the right."}, Limits::above(0));
  track.roll = read_roll(
      section, {"roll_deg", "Roll angle. `racetrack`: in the middle of a turn; `spiral`: constant."});
  track.depth = read_depth(section, track.speed);
  return track;
}

world::Motion read_spiral(Section& section) {
  world::Spiral spiral;
  spiral.speed = section.number({"speed_mps",
                                 "Speed along the vehicle's forward axis. `rest_then_go`: full speed, "
                                 "reached at the end of `start_s`; other trajectories: constant."},
                                Limits::above(0));
  spiral.heading = read_heading(section);
  spiral.period =
      section.number({"turn_period_s", "Period of the turns. `spiral`: time of a full turn to the right."},
                     Limits::above(0));
  spiral.roll = read_roll(
      section, {"roll_deg", "Roll angle. `racetrack`: in the middle of a turn; `spiral`: constant."});
  spiral.depth = read_depth(section, spiral.speed);
  return spiral;
}

world::Motion read_rest_then_go(Section& section) {
  world::RestThenGo motion;
  motion.speed = section.number({"speed_mps",
                                 "Speed along the vehicle's forward axis. `rest_then_go`: full speed, "
                                 "reached at the end of `start_s`; other trajectories: constant."},
                                Limits::above(0));
  motion.heading = read_heading(section);
  motion.rest =
      section.number({"rest_s", "Time at rest, before the carrier starts to move."}, Limits::at_least(0));
  motion.start = section.number({"start_s", "Time from rest to full speed."}, Limits::above(0));
  motion.depth = read_depth(section, motion.speed);
  return motion;
}

struct MotionReader {
  std::string_view name;
  world::Motion (*read)(Section&);
};
constexpr std::array motion_readers{MotionReader{"rest", read_rest},
                                    MotionReader{"level_acceleration", read_level_acceleration},
                                    MotionReader{"weave", read_weave},
                                    MotionReader{"s_path", read_s_path},
                                    MotionReader{"racetrack", read_racetrack},
                                    MotionReader{"spiral", read_spiral},
                                    MotionReader{"rest_then_go", read_rest_then_go},
                                    MotionReader{"legs", read_legs}};

}  // namespace

double read_heading(Section& section) {
  return section.number({"heading_deg",
                         "Heading. `rest`, `level_acceleration`: constant; `s_path`: the mean; other "
                         "trajectories: the heading at the start. `weave`: the heading then swings to "
                         "the right by twice `heading_amplitude_deg`, and back."},
                        Limits::between(-180, 360));
}

world::Flight read_truth(Section& section, std::int64_t duration_us, bool plant_moves) {
  std::vector<std::string> names;
  for (const MotionReader& reader : motion_readers) names.emplace_back(reader.name);
  names.insert(names.end(), {"waypoints", "recorded", "plant", "unknown"});
  const std::string name = section.one_of(
      {"trajectory",
       "How the carrier moves. `recorded`: as in a CSV file; `plant`: as "
       "the table [plant] says; `unknown`: there is no truth, and every node sends recorded samples."},
      names);
  world::Flight flight;
  if (name == "recorded") {
    flight = read_recorded_flight(section, duration_us);
  } else if (name == "unknown") {
    flight = read_unknown_flight(section);
  } else {
    flight.start = read_position(section);
  }
  const bool by_plant = name == "plant";
  if (by_plant && !plant_moves)
    section.reject("trajectory", "is 'plant', but no plant moves the carrier",
                   "a table [plant] whose outputs or [plant.motion] give an attitude or a velocity");
  if (!by_plant && plant_moves)
    section.reject("trajectory", fmt::format("is '{}', but the plant moves the carrier", name), "'plant'");
  if (by_plant) flight.motion = world::Grown{std::make_shared<world::GrownPath>(world::GrownPath::Point{})};
  if (name == "waypoints") flight.motion = read_waypoints(section, flight.start);
  for (const MotionReader& reader : motion_readers) {
    if (reader.name == name) flight.motion = reader.read(section);
  }
  flight.oscillations = read_oscillations(section, !by_plant && name != "recorded" && name != "unknown");
  section.finish();
  return flight;
}

}  // namespace canhil::scenario
