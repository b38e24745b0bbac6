// One line for each kind of sensor.
#include "bench/sensors/registry.hpp"

#include <array>
#include <deque>
#include <mutex>
#include <string>

#include "bench/sensors/air_data.hpp"
#include "bench/sensors/depth_gauge.hpp"
#include "bench/sensors/dvl.hpp"
#include "bench/sensors/fins.hpp"
#include "bench/sensors/generic.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/sensors/gnss_velocity.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/magnetometer.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/seeker.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/ssbl.hpp"
#include "bench/sensors/start.hpp"
#include "bench/sensors/wheels.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array registered{
    &master_ins,  // of the carrier
    &slave_imu,   // of the weapon, or of the vehicle
    &ssbl,        // of a ship
    &gps,         // of the vehicle
    &seeker,      // of a missile
    &glider_nav,  // the GPS/INS of the glider
    &fins,        // of the glider
    &gnss_velocity,
    &dvl,          // of an underwater vehicle
    &depth_gauge,  // of an underwater vehicle
    &air_data,     // of an aircraft
    &magnetometer,
    &wheels,   // of a car
    &generic,  // of the user's own
    &start,    // what somebody tells the device before it starts
};

}  // namespace

std::span<const Kind* const> all() { return registered; }

const Kind& named(const Kind& kind, std::string_view name) {
  struct Named {
    std::string name;
    Kind kind;
  };
  static std::mutex mutex;
  static std::deque<Named> known;
  const std::lock_guard lock(mutex);
  for (const Named& one : known) {
    if (one.kind.of == &kind && one.name == name) return one.kind;
  }
  Named& own = known.emplace_back(Named{.name = std::string(name), .kind = kind});
  own.kind.key = own.name;
  own.kind.of = &kind;
  return own.kind;
}

const Kind& declared(std::string_view name, const std::vector<DeclaredValue>& values) {
  struct Declared {
    std::string name;
    std::vector<DeclaredValue> values;
    std::vector<Output> outputs{};
    std::vector<std::string_view> flags{};  // each value has one of its name
    Kind kind{};
  };
  static std::mutex mutex;
  static std::deque<Declared> known;
  const std::lock_guard lock(mutex);
  for (const Declared& one : known) {
    if (one.name == name && one.values == values) return one.kind;
  }
  Declared& own = known.emplace_back(Declared{.name = std::string(name), .values = values});
  for (std::size_t i = 0; i < own.values.size(); ++i) {
    const DeclaredValue& value = own.values[i];
    own.outputs.push_back({.name = value.name,
                           .si = value.si.empty() ? plain_number : value.si,
                           .turns = value.turns,
                           .flags = 1U << i});
    own.flags.push_back(value.name);
  }
  own.kind = generic;
  own.kind.key = own.name;
  own.kind.of = &generic;
  own.kind.outputs = {.values = own.outputs, .flags = own.flags};
  return own.kind;
}

}  // namespace canhil::sensors
