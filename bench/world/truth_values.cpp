#include "bench/world/truth_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <mutex>
#include <string>

#include "bench/world/attitude.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::world {
namespace {

using Value = std::optional<double>;

constexpr double slowest_on_course = 0.1;  // [m/s]; at standstill, the direction of the motion is undefined

// A value from the flight record, at any time of the run.
template <class Of>
Value flown(const Truths& truths, std::int64_t t_us, Of of) {
  if (!truths.flight.is_known() || t_us < 0 || t_us > truths.flight.known_until_us()) return std::nullopt;
  return of(truths.flight.at(t_us));
}
// A value of the motion: of a plant that shows the motion, otherwise of the flight.
struct Motion {
  Vector3 v_eb_n;
  Matrix3 C_bn;
};
template <class Of>
Value moved(const Truths& truths, std::int64_t t_us, Of of) {
  constexpr PlantColumns<6>::Names names{"velocity.north", "velocity.east",  "velocity.down",
                                         "attitude.roll",  "attitude.pitch", "attitude.heading"};
  const auto own = PlantColumns<6>::find(truths.plants, names);
  if (!own) {
    return flown(truths, t_us, [&](const Truth& at) { return of(Motion{at.v_eb_n, at.C_bn}); });
  }
  const auto at = own->at(t_us);
  if (!at) return std::nullopt;
  const auto& [north, east, down, roll, pitch, heading] = *at;
  return of(Motion{{north, east, down}, C_bn_from({.roll = roll, .pitch = pitch, .heading = heading})});
}

template <double Euler::*angle>
Value attitude(const Truths& truths, std::int64_t t_us) {
  return moved(truths, t_us, [](const Motion& at) { return euler_from(at.C_bn).*angle; });
}
template <int axis>
Value velocity(const Truths& truths, std::int64_t t_us) {
  return moved(truths, t_us, [](const Motion& at) { return at.v_eb_n[axis]; });
}
template <int axis>
Value velocity_in_body(const Truths& truths, std::int64_t t_us) {
  return moved(truths, t_us, [](const Motion& at) { return at.C_bn.col(axis).dot(at.v_eb_n); });
}
Value ground_speed(const Truths& truths, std::int64_t t_us) {
  return moved(truths, t_us, [](const Motion& at) { return std::hypot(at.v_eb_n.x(), at.v_eb_n.y()); });
}
Value course(const Truths& truths, std::int64_t t_us) {
  return moved(truths, t_us, [](const Motion& at) -> Value {
    if (std::hypot(at.v_eb_n.x(), at.v_eb_n.y()) < slowest_on_course) return std::nullopt;
    return std::atan2(at.v_eb_n.y(), at.v_eb_n.x());
  });
}
template <double Position::*coordinate>
Value position(const Truths& truths, std::int64_t t_us) {
  return flown(truths, t_us, [](const Truth& at) { return at.position.*coordinate; });
}
template <int axis>
Value rate(const Truths& truths, std::int64_t t_us) {
  return flown(truths, t_us, [](const Truth& at) { return at.omega_ib_b[axis]; });
}
template <int axis>
Value force(const Truths& truths, std::int64_t t_us) {
  return flown(truths, t_us, [](const Truth& at) { return at.f_ib_b[axis]; });
}

using enum TruthIn;
constexpr std::array known{
    TruthValue{"attitude.roll", "rad", true, motion, attitude<&Euler::roll>},
    TruthValue{"attitude.pitch", "rad", true, motion, attitude<&Euler::pitch>},
    TruthValue{"attitude.heading", "rad", true, motion, attitude<&Euler::heading>},
    TruthValue{"velocity.north", "m/s", false, motion, velocity<0>},
    TruthValue{"velocity.east", "m/s", false, motion, velocity<1>},
    TruthValue{"velocity.down", "m/s", false, motion, velocity<2>},
    TruthValue{"velocity.x", "m/s", false, motion, velocity_in_body<0>},
    TruthValue{"velocity.y", "m/s", false, motion, velocity_in_body<1>},
    TruthValue{"velocity.z", "m/s", false, motion, velocity_in_body<2>},
    TruthValue{"ground_speed", "m/s", false, motion, ground_speed},
    TruthValue{"course", "rad", true, motion, course},
    TruthValue{"position.latitude", "rad", false, flight, position<&Position::latitude>},
    TruthValue{"position.longitude", "rad", true, flight, position<&Position::longitude>},
    TruthValue{"position.height", "m", false, flight, position<&Position::height>},
    TruthValue{"rate.x", "rad/s", false, flight, rate<0>},
    TruthValue{"rate.y", "rad/s", false, flight, rate<1>},
    TruthValue{"rate.z", "rad/s", false, flight, rate<2>},
    TruthValue{"specific_force.x", "m/s^2", false, flight, force<0>},
    TruthValue{"specific_force.y", "m/s^2", false, flight, force<1>},
    TruthValue{"specific_force.z", "m/s^2", false, flight, force<2>},
    TruthValue{"los.rate.pitch", "rad/s", false, plant},
    TruthValue{"los.rate.yaw", "rad/s", false, plant},
    TruthValue{"wind.north", "m/s", false, plant},
    TruthValue{"wind.east", "m/s", false, plant},
    TruthValue{"wind.down", "m/s", false, plant},
};

}  // namespace

std::span<const TruthValue> truth_values() { return known; }

namespace {

// A value is identified by its address, so a name gives one object.
const TruthValue& output_of_plant(std::string_view name) {
  struct Own {
    std::string name;
    TruthValue value{};
  };
  static std::mutex mutex;
  static std::deque<Own> known_outputs;
  const std::lock_guard lock(mutex);
  for (const Own& one : known_outputs) {
    if (one.name == name) return one.value;
  }
  Own& own = known_outputs.emplace_back(Own{.name = std::string(name)});
  own.value = {.name = own.name, .si = "", .in = plant};
  return own.value;
}

}  // namespace

std::optional<double> TruthValue::at(const Truths& truths, std::int64_t t_us) const {
  for (const PlantRecord* record : truths.plants) {
    if (const auto column = record->find(name)) return record->at(*column, t_us);
  }
  return of == nullptr ? std::nullopt : of(truths, t_us);
}

const TruthValue* find_truth_value(std::string_view name) {
  if (name.starts_with(plant_prefix) && name.size() > plant_prefix.size()) return &output_of_plant(name);
  const auto found = std::ranges::find(known, name, &TruthValue::name);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace canhil::world
