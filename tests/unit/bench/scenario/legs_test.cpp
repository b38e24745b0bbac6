// The trajectories "legs" and "waypoints", and what is added to a trajectory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "bench/scenario/route.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/motion/oscillation.hpp"
#include "bench/world/units.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using world::FlightRecord;
using world::Position;
using world::units::deg;

constexpr double g = world::units::standard_gravity;

std::string moving(std::string_view lines) {
  return with(
      "trajectory = \"rest\"\nlatitude_deg = 37.0\nlongitude_deg = 127.0\nheight_m = 1000.0\nheading_deg = "
      "90\n",
      fmt::format("latitude_deg = 37.0\nlongitude_deg = 127.0\nheight_m = 1000.0\n{}\n", lines));
}
std::string legs(std::string_view vehicle, std::string_view lines) {
  return moving(fmt::format("trajectory = \"legs\"\nheading_deg = 40\nvehicle = \"{}\"\n{}", vehicle, lines));
}
FlightRecord flown(std::string_view text, std::int64_t duration_us) {
  const Scenario scenario = parsed(text);
  return {world::drawn(scenario.truth, scenario.seed), duration_us, 20'000};
}
double heading_deg(const world::Truth& truth) { return world::euler_from(truth.C_bn).heading / deg; }

TEST(Legs, ACarStartsTurnsAndStops) {
  const auto record = flown(legs("car", R"(transition_s = 1
[[truth.leg]]
duration_s = 5
[[truth.leg]]
speed_mps = 15
acceleration_mps2 = 2.5
[[truth.leg]]
distance_m = 200
[[truth.leg]]
heading_deg = 130
turn_radius_m = 40
[[truth.leg]]
speed_mps = 0
acceleration_mps2 = 3
[[truth.leg]]
duration_s = 5)"),
                            60'000'000);
  EXPECT_EQ(record.at(5'000'000).v_eb_n.norm(), 0);
  // 15 m/s with 2.5 m/s^2 at most: 35/16 * 6 s = 13.125 s. Then 200 m take 13.333 s.
  EXPECT_NEAR(record.at(18'125'000).v_eb_n.norm(), 15, 1e-12);
  double greatest = 0, greatest_turn = 0;
  for (const auto& truth : record.epochs()) {
    if (truth.t_us < 18'000'000) greatest = std::max(greatest, std::abs(truth.f_ib_b.x()));
    greatest_turn = std::max(greatest_turn, truth.omega_ib_b.z());
  }
  EXPECT_NEAR(greatest, 2.5, 5e-3);
  EXPECT_NEAR(heading_deg(record.at(31'458'000)), 40, 1e-9);
  const double turn_s = 90 * deg / (15.0 / 40) + 1;
  EXPECT_NEAR(heading_deg(record.at(31'459'000 + std::llround(1e6 * turn_s))), 130, 1e-9);
  EXPECT_NEAR(greatest_turn, 15.0 / 40, 1e-4);
  EXPECT_EQ(record.at(60'000'000).v_eb_n.norm(), 0);
  EXPECT_EQ(record.at(60'000'000).position.latitude, record.at(52'000'000).position.latitude);
}

TEST(Legs, AnAircraftBanksAndClimbs) {
  const auto record = flown(legs("aircraft", R"(speed_mps = 60
angle_of_attack_deg = 3
[[truth.leg]]
climb_rate_mps = 5
duration_s = 12
[[truth.leg]]
climb_rate_mps = 0
[[truth.leg]]
bank_deg = -30
turn_deg = -180)"),
                            60'000'000);
  const auto climbing = record.at(8'000'000);
  EXPECT_NEAR(-climbing.v_eb_n.z(), 5, 1e-9);
  EXPECT_NEAR(climbing.v_eb_n.norm(), 60, 1e-9);
  EXPECT_NEAR(world::euler_from(climbing.C_bn).pitch, std::asin(5.0 / 60) + 3 * deg, 1e-12);
  // 5 m/s for the time of the leg, as the climb begins and ends within 2 s each.
  EXPECT_NEAR(record.at(14'000'000).position.height, 1060, 0.01);
  const auto turning = record.at(24'000'000);
  EXPECT_NEAR(world::euler_from(turning.C_bn).roll, -30 * deg, 1e-8);
  EXPECT_NEAR(turning.f_ib_b.y(), 0, 0.03) << "coordinated";
  EXPECT_NEAR(heading_deg(record.at(60'000'000)), -140, 1e-9);
}

TEST(Legs, AShipKeepsLevelAnAuvDivesAndARotorcraftFliesSideways) {
  const auto ship = flown(legs("ship",
                               "speed_mps = 8\nroll_per_g_deg = 60\n[[truth.leg]]\nduration_s = "
                               "60\nturn_rate_degps = 1.5"),
                          60'000'000);
  EXPECT_NEAR(world::euler_from(ship.at(30'000'000).C_bn).roll, -60 * deg * 8 * 1.5 * deg / g, 1e-9);
  EXPECT_NEAR(heading_deg(ship.at(60'000'000)), 40 + 1.5 * 58, 1e-9);
  const auto auv =
      flown(legs("auv", "speed_mps = 2\n[[truth.leg]]\nclimb_angle_deg = -20\ndistance_m = 100"), 60'000'000);
  EXPECT_NEAR(world::euler_from(auv.at(30'000'000).C_bn).pitch, -20 * deg, 1e-12);
  EXPECT_NEAR(auv.at(50'000'000).v_eb_n.z(), 2 * std::sin(20 * deg), 1e-12);
  const auto rotorcraft =
      flown(legs("rotorcraft", "[[truth.leg]]\nspeed_mps = 10\ndrift_deg = 90\nduration_s = 20"), 30'000'000);
  EXPECT_LT(
      (rotorcraft.at(20'000'000).v_eb_n - 10 * world::Vector3(std::cos(130 * deg), std::sin(130 * deg), 0))
          .norm(),
      1e-12);
  EXPECT_NEAR(heading_deg(rotorcraft.at(20'000'000)), 40, 1e-12);
}

struct WrongLeg {
  std::string vehicle, lines, error;
};
class LegError : public testing::TestWithParam<WrongLeg> {};
TEST_P(LegError, NamesTheLegAndTheKey) {
  EXPECT_EQ(error_of(legs(GetParam().vehicle, GetParam().lines)), "s.toml:" + GetParam().error);
}
const std::string first = "speed_mps = 20\n[[truth.leg]]\nduration_s = 5\n[[truth.leg]]\n";
INSTANTIATE_TEST_SUITE_P(
    All, LegError,
    testing::Values(
        WrongLeg{"car", first,
                 "18: key 'truth.leg[2].duration_s': is missing, expected it, or distance_m, or a change"},
        WrongLeg{"car", first + "turn_deg = 90",
                 "18: key 'truth.leg[2].duration_s': is missing, expected it, or turn_rate_degps, "
                 "turn_radius_m or "
                 "bank_deg: how fast to turn"},
        WrongLeg{"car", first + "turn_rate_degps = 9",
                 "18: key 'truth.leg[2].duration_s': is missing, expected it, or turn_deg: how far to turn"},
        WrongLeg{"car", first + "turn_deg = 90\nturn_rate_degps = 9\nduration_s = 11",
                 "21: key 'truth.leg[2].duration_s': lasts 11 s, but the changes of the leg last longer, "
                 "expected at "
                 "least 12 s"},
        WrongLeg{"car", first + "turn_deg = 90\nheading_deg = 9\nduration_s = 11",
                 "20: key 'truth.leg[2].heading_deg': is given beside turn_deg, expected one of the two"},
        WrongLeg{
            "car", first + "speed_mps = 0\ndistance_m = 9",
            "20: key 'truth.leg[2].distance_m': is never reached, as the speed is 0 at the end of the leg, "
            "expected duration_s"},
        WrongLeg{"car", first + "speed_mps = 10\ndistance_m = 9",
                 "20: key 'truth.leg[2].distance_m': is covered before the speed is reached, expected at "
                 "least 30"},
        WrongLeg{"car", first + "bank_deg = 9\nduration_s = 10",
                 "19: key 'truth.leg[2].bank_deg': has no effect on a vehicle \"car\", expected vehicle = "
                 "\"aircraft\" "
                 "or \"rotorcraft\""},
        WrongLeg{"ship", first + "climb_rate_mps = 1\nduration_s = 10",
                 "19: key 'truth.leg[2].climb_rate_mps': has no effect on a vehicle \"ship\", expected no "
                 "such key"},
        WrongLeg{"auv", first + "climb_rate_mps = 30\nduration_s = 10",
                 "19: key 'truth.leg[2].climb_rate_mps': is too steep for 20 m/s along the path, expected at "
                 "most 19.6"},
        WrongLeg{
            "aircraft", first + "drift_deg = 30\nduration_s = 10",
            "19: key 'truth.leg[2].drift_deg': has no effect on a vehicle \"aircraft\", expected vehicle = "
            "\"rotorcraft\""},
        WrongLeg{"aircraft", first + "speed_mps = -3\nduration_s = 10",
                 "19: key 'truth.leg[2].speed_mps': is negative, expected at least 0"},
        WrongLeg{"rotorcraft", first + "climb_rate_mps = -20\nduration_s = 10",
                 "19: key 'truth.leg[2].climb_rate_mps': falls with almost 1 g or more, which no rotor holds "
                 "upright, "
                 "expected transition_s of at least 4.96"},
        WrongLeg{"car", first + "speed_mps = 20\nturn_radius_m = 0\nduration_s = 9",
                 "20: key 'truth.leg[2].turn_radius_m': is 0, expected a radius"},
        WrongLeg{
            "car", first + "acceleration_mps2 = 2\nduration_s = 9",
            "19: key 'truth.leg[2].acceleration_mps2': has no effect alone, expected speed_mps beside it"},
        WrongLeg{"car", first + "sped_mps = 20\nduration_s = 9",
                 "19: key 'truth.leg[2].sped_mps': is unknown, expected 'speed_mps'"},
        WrongLeg{"lorry", first,
                 "14: key 'truth.vehicle': 'lorry' is unknown, expected one of: car, ship, auv, aircraft, "
                 "rotorcraft"},
        WrongLeg{"car", "speed_mps = 3", "8: key 'truth.leg': is missing, expected at least one [[leg]]"}));

constexpr std::string_view square = R"(trajectory = "waypoints"
vehicle = "auv"
speed_mps = 2
turn_radius_m = 20
[[truth.waypoint]]
north_m = 300
east_m = 0
[[truth.waypoint]]
north_m = 300
east_m = 400
up_m = -40
[[truth.waypoint]]
north_m = -500
east_m = 400
up_m = -10
)";

/// The least distance between the flight and a position, and its time.
std::pair<double, double> closest_approach(const FlightRecord& record, const Position& position) {
  double least = 1e9, at = 0;
  for (const auto& truth : record.epochs()) {
    const double distance = world::displacement_n(position, truth.position).norm();
    if (distance >= least) continue;
    least = distance;
    at = 1e-6 * static_cast<double>(truth.t_us);
  }
  return {least, at};
}

TEST(Waypoints, ArePassedOnTheInsideAndTheLastIsReached) {
  const auto record = flown(moving(square), 800'000'000);
  const Position start = record.epochs()[0].position;
  const auto there = [&](double north, double east, double up) {
    Position position = world::displaced(start, {north, east, 0});
    position.height = start.height + up;
    return position;
  };
  EXPECT_NEAR(heading_deg(record.epochs()[0]), 0, 1e-3);
  // On a circle of 20 m, a turn of 90 deg passes at 20 m (sqrt 2 - 1) = 8.3 m. Its smooth ends make it wider.
  for (const Position& corner : {there(300, 0, 0), there(300, 400, -40)}) {
    const auto [distance, at] = closest_approach(record, corner);
    EXPECT_GT(distance, 8.2);
    EXPECT_LT(distance, 8.7);
    EXPECT_NEAR(record.at(std::llround(1e6 * at)).position.height, corner.height, 1e-3)
        << "level at the waypoint";
  }
  EXPECT_LT(closest_approach(record, there(-500, 400, -10)).first, 0.02 + 1e-3) << "half a step at 2 m/s";
}

// The straight line between two turns is hardly longer than the begin and the end of the climb.
TEST(Waypoints, AClimbOnAShortLineIsMet) {
  RoutePlan plan{.carrier = {.vehicle = world::Vehicle::aircraft},
                 .speed = 25,
                 .turn_rate = 0.18,
                 .transition_us = 2'000'000,
                 .speed_us = 10'000'000};
  const Position start{.latitude = 47 * deg, .longitude = 8 * deg, .height = 1200};
  const auto there = [&](double north, double east, double height) {
    Position position = world::displaced(start, {north, east, 0});
    position.height = height;
    return position;
  };
  for (const double east : {380.0, 400.0, 420.0, 500.0}) {
    const std::vector<Position> waypoints{there(400, 0, 1200), there(400, east, 1230), there(0, 600, 1200)};
    const auto route = plan_route(plan, start, waypoints);
    ASSERT_TRUE(route) << east << ": " << route.error().what;
    const FlightRecord record({.start = start,
                               .motion = world::Legs{std::make_shared<const world::LegPath>(
                                   plan.carrier, plan.speed, route->heading, route->legs)}},
                              route->times_us.back() + 100'000, 10'000);
    for (std::size_t i = 0; i < waypoints.size(); ++i)
      EXPECT_NEAR(world::displacement_n(record.at(route->times_us[i]).position, waypoints[i]).norm(),
                  route->passes[i], 0.02)
          << east << " " << i;
  }
}

TEST(Waypoints, OnALongRouteAndNearThePoleTooAreMet) {
  RoutePlan plan{.carrier = {.vehicle = world::Vehicle::aircraft},
                 .speed = 200,
                 .turn_rate = 0.03,
                 .transition_us = 3'000'000,
                 .speed_us = 60'000'000};
  for (const double latitude : {-30.0, 0.0, 55.0, 80.0}) {
    const Position start{.latitude = latitude * deg, .longitude = 179.5 * deg, .height = 1000};
    std::vector<Position> waypoints;
    for (const auto& [north, east, up] :
         {std::tuple{0.8, 1.0, 9000.0}, {1.5, -2.0, 11'000.0}, {-0.4, -1.0, 11'000.0}, {0.0, 1.0, 500.0}})
      waypoints.push_back({.latitude = (latitude + north) * deg,
                           .longitude = world::wrapped((179.5 + east) * deg),
                           .height = up});
    for (const bool rests : {false, true}) {
      plan.from_rest = plan.stops = rests;
      const auto route = plan_route(plan, start, waypoints);
      ASSERT_TRUE(route) << route.error().what;
      const FlightRecord record({.start = start,
                                 .motion = world::Legs{std::make_shared<const world::LegPath>(
                                     plan.carrier, rests ? 0 : plan.speed, route->heading, route->legs)}},
                                route->times_us.back() + 1'000'000, 1'000'000);
      for (std::size_t i = 0; i < waypoints.size(); ++i) {
        const auto passed = record.at(route->times_us[i]);
        EXPECT_NEAR(world::displacement_n(passed.position, waypoints[i]).norm(), route->passes[i], 0.02)
            << latitude << " " << i;
      }
      EXPECT_EQ(route->passes.back(), 0);
      EXPECT_EQ(record.epochs().back().v_eb_n.norm() == 0, rests);
    }
  }
}

TEST(Waypoints, AreRefusedWithTheirNumbers) {
  const auto error = [](std::string_view from, std::string_view to) {
    return error_of(moving(with(from, to, square)));
  };
  EXPECT_EQ(error("turn_radius_m = 20", "turn_radius_m = 250"),
            "s.toml:20: key 'truth.waypoint[2].north_m': is 399.986 m from waypoint[1], but the turns and "
            "changes of "
            "speed between them need 504.002 m, expected a smaller turn radius or speed, or waypoints "
            "further apart");
  EXPECT_EQ(
      error("turn_radius_m = 20", "turn_radius_m = 20\nwithin_m = 5"),
      "s.toml:18: key 'truth.waypoint[1].north_m': is passed at 8.3 m, expected at most within_m = 5, by a "
      "smaller turn radius");
  EXPECT_EQ(
      error("up_m = -40", "up_m = -900"),
      "s.toml:22: key 'truth.waypoint[2].up_m': is 900 m below waypoint[1], on a straight line of 355.964 m, "
      "expected a climb of at most 60 deg on a line of at least 8 m");
  EXPECT_EQ(error("north_m = -500", "north_m = 300"),
            "s.toml:24: key 'truth.waypoint[3].north_m': is at the same place as waypoint[2], expected "
            "another place");
  EXPECT_EQ(error("north_m = -500\neast_m = 400", "north_m = 300\neast_m = 10"),
            "s.toml:20: key 'truth.waypoint[2].north_m': needs a turn of 180 deg, expected at most 170");
  EXPECT_EQ(
      error("turn_radius_m = 20\n", ""),
      "s.toml:8: key 'truth.turn_radius_m': is missing, expected it, turn_rate_degps or bank_deg: how the "
      "vehicle turns at a waypoint");
  EXPECT_EQ(error("up_m = -40", "height_m = 20"),
            "s.toml:22: key 'truth.waypoint[2].height_m': is given without latitude_deg and longitude_deg, "
            "expected "
            "up_m");
  EXPECT_EQ(error("east_m = 400", "latitude_deg = 3"),
            "s.toml:20: key 'truth.waypoint[2].north_m': is given beside latitude_deg, longitude_deg, "
            "expected either "
            "latitude_deg, longitude_deg or north_m, east_m");
}

constexpr std::string_view shaken = R"([truth.vibration]
[[truth.vibration.sine]]
frequency_hz = 30
acceleration_g = [0, 0, 0.5]
[[truth.vibration.random]]
from_hz = 20
to_hz = 200
psd_g2phz = 0.001
lines = 10
[truth.sea]
significant_height_m = 2
peak_period_s = 7
from_deg = 200
length_m = 12
[master_ins])";

TEST(Oscillations, AreReadAndAddedToABuiltInTrajectory) {
  const Scenario scenario = parsed(with("[master_ins]", shaken));
  const auto& model = *scenario.truth.oscillations;
  ASSERT_EQ(model.sinusoids.size(), 1U);
  EXPECT_NEAR(model.sinusoids[0].acceleration.z(), 0.5 * g, 1e-12);
  EXPECT_FALSE(model.sinusoids[0].phase);
  ASSERT_EQ(model.random.size(), 1U);
  EXPECT_NEAR(model.random[0].psd.x(), 0.001 * g * g, 1e-12);
  EXPECT_EQ(model.random[0].lines, 10);
  EXPECT_EQ(model.sea->peakedness, 1);
  EXPECT_NEAR(model.sea->from, 200 * deg, 1e-12);
  EXPECT_EQ(parsed(valid).truth.oscillations, nullptr);
}

TEST(Oscillations, AreRefusedWithTheReason) {
  const auto error = [](std::string_view from, std::string_view to) {
    return error_of(with("[master_ins]", with(from, to, shaken)));
  };
  EXPECT_EQ(error("frequency_hz = 30", "frequency_hz = 3000"),
            "s.toml:16: key 'truth.vibration.sine[1].frequency_hz': 3000 is out of range, expected a number "
            "from 0.1 "
            "to 2000");
  EXPECT_EQ(error("to_hz = 200", "to_hz = 10"),
            "s.toml:20: key 'truth.vibration.random[1].to_hz': is not above from_hz, expected a frequency "
            "above it");
  EXPECT_EQ(error("lines = 10", "lines = 1000"),
            "s.toml:22: key 'truth.vibration.random[1].lines': are too many, expected at most 200");
  EXPECT_EQ(
      error("length_m = 12", "length_m = 12\npeakedness = 2"),
      "s.toml:28: key 'truth.sea.peakedness': has no effect here, expected spectrum = \"jonswap\" beside it");
  EXPECT_EQ(
      error_of(with("[master_ins]", "[truth.vibration]\n[master_ins]")),
      "s.toml:14: key 'truth.vibration.sine': is missing, expected at least one [[truth.vibration.sine]] or "
      "[[truth.vibration.random]]");
  EXPECT_EQ(
      error_of(with("[master_ins]", std::string(shaken),
                    with("trajectory = \"rest\"", "trajectory = \"unknown\""))),
      "s.toml:14: key 'truth.vibration': cannot be added to this trajectory, expected it with a built-in "
      "trajectory only");
}

// Every example of a trajectory in the documentation is a valid one.
TEST(Trajectories, OfTheDocumentationAreRead) {
  std::ifstream file(SOURCE_DIR "/docs/scenarios.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  int examples = 0;
  for (std::size_t at = page.find("```toml\n"); at != std::string::npos; at = page.find("```toml\n", at)) {
    at += 8;
    std::string example = page.substr(at, page.find("```", at) - at);
    if (example.find("truth.") == std::string::npos) continue;
    ++examples;
    if (example.find("[truth]\n") == std::string::npos) {
      EXPECT_EQ(error_of(with("[master_ins]", example + "[master_ins]")), "no error") << example;
      continue;
    }
    if (example.find("latitude_deg") == std::string::npos)
      example = with("[truth]\n", "[truth]\nlatitude_deg = 1\nlongitude_deg = 2\nheight_m = 3\n", example);
    std::string text(valid);
    const std::size_t truth = text.find("[truth]");
    text.replace(truth, text.find("[master_ins]") - truth, example);
    EXPECT_EQ(error_of(text), "no error") << example;
  }
  EXPECT_EQ(examples, 7);
}

}  // namespace
}  // namespace canhil::scenario
