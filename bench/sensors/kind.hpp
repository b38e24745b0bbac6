// A sensor and the properties of a kind of sensor. Each kind defines them in its own file; all other code
// iterates over the registry or over the nodes of a scenario.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "bench/sensors/sample.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/plant_record.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

using scenario::Limits;
using scenario::NodeSettings;
using scenario::NodeTable;
using scenario::Section;
using scenario::Stated;

class SensorFaults;

/// The inputs of the sensors in a run. Every object to which this struct refers must outlive the sensors.
struct Run {
  const scenario::Scenario& scenario;
  std::uint64_t index = 0;
  const world::FlightRecord& flight;  ///< from the start to the end of the run
  world::PlantRecords plants{};       ///< filled before or during the flight
  SensorFaults* faults = nullptr;     ///< null: no faults
  std::string_view sensor{};          ///< name of a named sensor, which has streams of its own
  /// Guides the plant that the target's answers guide (plant::Simulation::guide()); empty: there is none.
  std::function<void(std::int64_t from_us, std::span<const double> inputs)> guide{};
  /// Ends the run, because a sensor cannot measure any more. `why`: one phrase.
  std::function<void(std::string why)> fail{};
  struct Overrides* overrides = nullptr;  ///< by partners of the run; null: there are none

  /// A stream of random numbers. The name must never change: the results depend on it.
  [[nodiscard]] world::Stream stream(std::string_view name) const {
    if (sensor.empty()) return {scenario.seed, index, name};
    return {scenario.seed, index, std::string(sensor) + ": " + std::string(name)};
  }
};

/// The target's estimate of the LOS rate, as the guidance of a missile uses it.
struct Guidance {
  std::int64_t cause_us = 0;             ///< time of validity of the sample that the target answered
  world::Planes<double> los_rate{};      ///< [rad/s]
  world::Planes<double> acceleration{};  ///< of the flight target [m/s^2]
};

/// A sensor of a node. All times are in the bench's time base [us].
class Sensor {
 public:
  Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;
  virtual ~Sensor() = default;

  /// Time at which the next sample is sent; never_us after the last one.
  [[nodiscard]] virtual std::int64_t due_us() const = 0;
  /// Measures the due sample and advances to the next.
  virtual Sample measure() = 0;

  /// Whether the target's answers guide the vehicle of this sensor.
  [[nodiscard]] virtual bool is_guided() const { return false; }
  virtual void guide(const Guidance& /*answer*/) {}
};

/// The faults of a run that act on samples.
class SensorFaults {
 public:
  SensorFaults() = default;
  SensorFaults(const SensorFaults&) = delete;
  SensorFaults& operator=(const SensorFaults&) = delete;
  virtual ~SensorFaults() = default;
  /// Whether some fault acts on this sensor.
  [[nodiscard]] virtual bool act_on(const NodeSettings& node) const = 0;
  /// Wraps a sensor in its faults.
  virtual std::unique_ptr<Sensor> with_faults(std::unique_ptr<Sensor> sensor, const NodeSettings& node) = 0;
};

/// Makes a sensor of type `Made`.
template <class Made>
std::unique_ptr<Sensor> make(const NodeSettings& node, const Run& run) {
  return std::make_unique<Made>(node, run);
}

struct Kind {
  std::string_view key;        ///< key of the sensor's table: "gps"
  std::string_view samples{};  ///< NodeTable::samples
  /// Reads the table; unknown keys are detected afterwards.
  NodeSettings (*read)(const NodeTable& table, Section& section) = nullptr;
  std::unique_ptr<Sensor> (*make)(const NodeSettings& node, const Run& run) = nullptr;
  Outputs outputs;
  std::int64_t period_us = 0;  ///< usual period, if canhil.dbc has no message of the sensor
  std::optional<scenario::Aid> aid{};
  bool at_every_epoch = false;  ///< the sensor's period defines the epochs of the flight record
  const Kind* of = nullptr;     ///< the kind of a named sensor, whose name is `key`; null: no name of its own
  bool only_named = false;      ///< a mapping declares the name and the values of each such sensor
  /// What the maker of the sensor would state about its errors beyond noise and bias. A target's parameter of
  /// the same name has this value unless the scenario sets it. Null: nothing.
  std::vector<scenario::Stated> (*data_sheet)(const NodeSettings& node) = nullptr;
  /// Why a scenario has no truth of what the sensor measures; empty: it has. Null: `samples` says it.
  std::string (*why_no_truth)(const NodeSettings& node, const scenario::Scenario& scenario) = nullptr;
};

}  // namespace canhil::sensors
