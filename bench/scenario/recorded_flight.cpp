#include "bench/scenario/recorded_flight.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bench/scenario/section.hpp"
#include "bench/scenario/table.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

using world::units::deg;

// No vehicle turns or accelerates faster than these limits. A recording that exceeds the limits has a wrong
// row.
constexpr double most_turn_rate = 1000 * deg;    // [rad/s]
constexpr double most_acceleration = 1000;       // [m/s^2]
constexpr double most_turn_of_a_row = 45 * deg;  // beyond this the direction of the turn is ambiguous
constexpr double usual_gap_s = 0.2;              // the IMU gap that a target bridges
constexpr double usual_agreement_m = 5;

enum Place : std::size_t { time, latitude, longitude, height, north, east, down, roll, pitch, heading };
struct Quantity {
  std::string_view name;
  Limits limits{};  // in the unit of the name's suffix
};
// Latitude and height have the limits of read_position(). Longitude, roll and heading may exceed 180 deg.
const std::array<Quantity, 10> quantities{{{"t_s", {}},
                                           {"latitude_deg", Limits::between(-89, 89)},
                                           {"longitude_deg", Limits::between(-180, 360)},
                                           {"height_m", Limits::between(-1000, 50'000)},
                                           {"velocity_north_mps", Limits::between(-10'000, 10'000)},
                                           {"velocity_east_mps", Limits::between(-10'000, 10'000)},
                                           {"velocity_down_mps", Limits::between(-10'000, 10'000)},
                                           {"roll_deg", Limits::between(-360, 360)},
                                           {"pitch_deg", Limits::between(-90, 90)},
                                           {"heading_deg", Limits::between(-360, 360)}}};

bool has_position(const Table& table) {
  return table.has(latitude) || table.has(longitude) || table.has(height);
}

/// All columns except positions are required; positions must be complete or absent.
Result<void> check_columns(const Table& table) {
  for (std::size_t index = 0; index < quantities.size(); ++index) {
    const bool of_position = index == latitude || index == longitude || index == height;
    if (table.has(index) || (of_position && !has_position(table))) continue;
    Error error = table.missing(index);
    if (index == north || index == east || index == down)
      error.message += " (the velocity cannot be had from positions: their rounding would be accelerations)";
    return tl::unexpected(std::move(error));
  }
  return {};
}

Result<void> check_ranges(const Table& table) {
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t index = 1; index < quantities.size(); ++index) {
      const Limits& limits = quantities[index].limits;
      const double value = table.value(row, index);
      if (!table.has(index) || holds(limits, value)) continue;
      return tl::unexpected(
          table.about(row, index,
                      fmt::format("{:g} {} is out of range, expected {:g} to {:g}", value,
                                  quantities[index].name.substr(quantities[index].name.rfind('_') + 1),
                                  limits.least, limits.most)));
    }
  }
  return {};
}

world::RecordedState state_of(const Table& table, std::size_t row, std::int64_t t_us) {
  const auto at = [&](Place index) { return table.value(row, index) * factor_of(quantities[index].name); };
  world::RecordedState state{
      .t_us = t_us,
      .v_eb_n = world::Vector3(at(north), at(east), at(down)),
      .C_bn = world::C_bn_from({.roll = at(roll), .pitch = at(pitch), .heading = at(heading)})};
  if (has_position(table))
    state.position = world::Position{
        .latitude = at(latitude), .longitude = world::wrapped(at(longitude)), .height = at(height)};
  return state;
}

/// Checks for each step between rows whether a vehicle can move so fast.
Result<void> check_steps(const Table& table, const Rows& rows,
                         const std::vector<world::RecordedState>& states) {
  for (std::size_t i = 1; i < states.size(); ++i) {
    const std::size_t row = rows.first + i;
    const double dt = 1e-6 * static_cast<double>(states[i].t_us - states[i - 1].t_us);
    const world::Matrix3 turn = states[i - 1].C_bn.transpose() * states[i].C_bn;
    const double angle = std::abs(Eigen::AngleAxisd(turn).angle());
    if (angle > std::min(most_turn_rate * dt, most_turn_of_a_row))
      return tl::unexpected(table.about(
          row, heading,
          fmt::format("the attitude turns by {:.1f} deg within {:g} s of the row before, expected at most "
                      "{:g} deg/s, and {:g} deg from row to row",
                      angle / deg, dt, most_turn_rate / deg, most_turn_of_a_row / deg)));
    const double change = (states[i].v_eb_n - states[i - 1].v_eb_n).norm();
    if (change > most_acceleration * dt)
      return tl::unexpected(table.about(
          row, north,
          fmt::format("the velocity changes by {:.3g} m/s within {:g} s of the row before, expected at most "
                      "{:g} m/s2",
                      change, dt, most_acceleration)));
  }
  return {};
}

Result<void> check_agreement(const Table& table, const Rows& rows, const world::RecordedPath& path,
                             double within) {
  const auto& worst = path.contradiction();
  const double most_velocity = within / world::RecordedPath::averaged_s;
  if (worst.velocity > most_velocity)
    return tl::unexpected(
        table.about(rows.first + worst.velocity_at, north,
                    fmt::format("velocity and positions contradict each other: over {:g} s they differ by "
                                "{:.3g} m/s, expected at most {:g} (key 'agree_within_m')",
                                world::RecordedPath::averaged_s, worst.velocity, most_velocity)));
  if (worst.position > within)
    return tl::unexpected(
        table.about(rows.first + worst.position_at, latitude,
                    fmt::format("velocity and positions contradict each other: the way by the velocities "
                                "passes {:.3g} m from this position, expected at most {:g} "
                                "(key 'agree_within_m')",
                                worst.position, within)));
  return {};
}

struct Wanted {
  std::int64_t from_us = 0, gap_us = 0, duration_us = 0;
  double agree_within = 0;
  std::optional<world::Position> start{};  // for a file without positions
};

Result<world::Flight> flight_of(const Table& table, const Wanted& wanted) {
  if (auto fine = check_columns(table); !fine) return tl::unexpected(fine.error());
  if (auto fine = check_ranges(table); !fine) return tl::unexpected(fine.error());
  const auto t_us = times_of(table, time, wanted.from_us);
  if (!t_us) return tl::unexpected(t_us.error());
  const auto rows = covering(table, time, *t_us, wanted.duration_us, wanted.gap_us);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<world::RecordedState> states;
  for (std::size_t row = rows->first; row <= rows->last; ++row)
    states.push_back(state_of(table, row, (*t_us)[row]));
  if (auto fine = check_steps(table, *rows, states); !fine) return tl::unexpected(fine.error());
  auto path = std::make_shared<const world::RecordedPath>(states, wanted.start.value_or(world::Position{}));
  if (auto fine = check_agreement(table, *rows, *path, wanted.agree_within); !fine)
    return tl::unexpected(fine.error());
  const world::Position start = path->position(0);
  return world::Flight{.start = start, .motion = world::Recorded{.path = std::move(path)}};
}

constexpr std::array<std::string_view, 3> start_keys{"latitude_deg", "longitude_deg", "height_m"};

}  // namespace

std::int64_t read_from_us(Section& section) {
  return std::llround(1e6 * section.number({"from_s", "Time in the file at which the run begins."},
                                           Limits::between(-1e11, 1e11), 0));
}

world::Position read_position(Section& section) {
  // NED axes have no north at a pole, hence 89 degrees.
  return {.latitude = section.number({"latitude_deg",
                                      "Latitude of the start. With `recorded`, this key is required if the "
                                      "file has no positions, and refused if the file has positions."},
                                     Limits::between(-89, 89)),
          .longitude = section.number({"longitude_deg",
                                       "Longitude of the start. With `recorded`, this key is required if the "
                                       "file has no positions, and refused if the file has positions."},
                                      Limits::between(-180, 180)),
          .height = section.number(
              {"height_m",
               "Height of the start above the ellipsoid. With `recorded`, this key is required if the file "
               "has no positions, and refused if the file has positions."},
              Limits::between(-1000, 50'000))};
}

world::Flight read_recorded_flight(Section& section, std::int64_t duration_us) {
  Wanted wanted{
      .from_us = read_from_us(section),
      .gap_us = section.time_us(
          {"gap_s",
           "Longest permitted time from a row of the file to the next. A file with a longer gap is refused."},
          Limits::above(0), usual_gap_s),
      .duration_us = duration_us,
      .agree_within = section.number(
          {"agree_within_m",
           "Limit for the disagreement of velocities and positions in the file. The bench compares the "
           "positions with the integral of the velocities: the two must not drift apart by more than this "
           "value within 10 s. The bench then corrects the velocities by the drift; after that, the "
           "difference must not exceed this value in any row."},
          Limits::above(0), usual_agreement_m)};
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities) names.emplace_back(quantity.name);
  const auto text = section.read_beside({"file", "CSV file of the flight, relative to the scenario file."},
                                        "a CSV file", most_recorded_bytes);
  if (!text) {
    read_position(section);  // adds these keys to the reference: without the file it is unknown whether the
                             // run needs them
    return {};
  }
  const auto table = read_table(
      *text, section.beside(section.text({"file", "CSV file of the flight, relative to the scenario file."})),
      names);
  if (table && has_position(*table)) {
    for (const std::string_view key : start_keys)
      section.refuse(key, "is given, and the file has positions", "it only for a file without them");
  } else if (table) {
    wanted.start = read_position(section);
  }
  if (section.error()) return {};
  const auto flight =
      table.and_then([&](const Table& rows) -> Result<world::Flight> { return flight_of(rows, wanted); });
  if (!flight) section.reject("file", flight.error());
  return flight.value_or(world::Flight{});
}

world::Flight read_unknown_flight(Section& section) {
  return {.start = read_position(section),
          .motion = world::Unknown{
              .v_eb_n = section.three(
                  {"velocity_mps", "Initial velocity that the bench sends to the target, [N, E, D]."},
                  Limits::between(-10'000, 10'000)),
              .angles = {
                  .roll = section.number({"roll_deg", "Roll at the start that the target receives."},
                                         Limits::between(-180, 180), 0),
                  .pitch = section.number({"pitch_deg", "Pitch at the start that the target receives."},
                                          Limits::between(-90, 90), 0),
                  .heading = section.number({"heading_deg", "Heading at the start that the target receives."},
                                            Limits::between(-180, 360))}}};
}

}  // namespace canhil::scenario
