// Binds the sensors to the messages of canhil.dbc.
#include "bench/nodes/registry.hpp"

#include <algorithm>
#include <cctype>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "bench/nodes/bound_sensor.hpp"
#include "bench/nodes/fits.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/sensors/overrides.hpp"
#include "bench/sensors/program.hpp"
#include "bench/sensors/registry.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {
namespace {

// "MasterIns" -> "master_ins": the table key of a sender.
std::string key_of(std::string_view sender) {
  std::string key;
  for (const char c : sender) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0 && !key.empty()) key += '_';
    key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return key;
}

// The DBC binds a sensor to the messages of the sender with its name; the one with the highest id closes the
// sample group. Null: the DBC has no such sender.
const MessageInfo* closing_message(std::string_view key) {
  const MessageInfo* closes = nullptr;
  for (const MessageInfo& message : messages::all_messages) {
    if (key_of(message.sender) == key && (closes == nullptr || message.id > closes->id)) closes = &message;
  }
  return closes;
}

const sensors::Kind* sensor_of(const Kind& kind) { return kind.table.sensor; }

const std::vector<Kind>& kinds() {
  static const auto bound = [] {
    std::vector<Kind> kinds;
    for (const sensors::Kind* sensor : sensors::all()) {
      const MessageInfo* closes = closing_message(sensor->key);
      const bool is_sent = closes != nullptr;
      kinds.push_back(
          {.table = {.key = sensor->key,
                     .closes = closes,
                     .period_us = is_sent ? closes->cycle_time_us : sensor->period_us,
                     .sensor = sensor,
                     .samples = sensor->samples,
                     .only_named = sensor->only_named,
                     .read = sensor->read,
                     .aid = sensor->aid,
                     .data_sheet = sensor->data_sheet},
           .signals = is_sent ? signals_of(*closes, sensor->outputs) : signals_in_si(sensor->outputs),
           .fits = fits_of(sensor->key)});
    }
    return kinds;
  }();
  return bound;
}

}  // namespace

std::span<const Kind* const> all() {
  static const auto pointers = [] {
    std::vector<const Kind*> all;
    for (const Kind& kind : kinds()) {
      if (kind.table.closes != nullptr) all.push_back(&kind);
    }
    return all;
  }();
  return pointers;
}

const Kind& bound(const sensors::Kind& sensor) {
  if (sensor.of == nullptr) return *std::ranges::find(kinds(), &sensor, sensor_of);
  static std::mutex mutex;
  static std::deque<Kind> named;
  const std::lock_guard lock(mutex);
  const auto found = std::ranges::find(named, &sensor, sensor_of);
  if (found != named.end()) return *found;
  Kind& own = named.emplace_back(bound(*sensor.of));
  own.table.key = sensor.key;
  own.table.sensor = &sensor;
  if (sensor.only_named) own.signals = signals_in_si(sensor.outputs);
  return own;
}

const Kind& kind_of(const NodeTable& table) { return bound(*table.sensor); }

const NodeTable* named(const NodeTable& kind, std::string_view name, const scenario::Binding& binding) {
  const auto known = std::ranges::find_if(
      binding.sensors, [&](const sensors::Kind* one) { return one->key == name && one->of == kind.sensor; });
  if (known != binding.sensors.end()) return &bound(**known).table;
  return kind.only_named ? nullptr : &bound(sensors::named(*kind.sensor, name)).table;
}

std::vector<const scenario::NodeTable*> tables() {
  std::vector<const scenario::NodeTable*> tables;
  for (const Kind& kind : kinds()) tables.push_back(&kind.table);
  return tables;
}

const SampleSignal& carrier(const sensors::Measurand& measurand) {
  const auto& signals = bound(*measurand.sensor).signals;
  return *std::ranges::find_if(signals, [&](const SampleSignal& signal) {
    return signal.role == sensors::Role::value && signal.index == measurand.index;
  });
}

const SampleSignal* carried(const Kind& kind, const MessageInfo& message, std::string_view signal) {
  const auto found = std::ranges::find_if(kind.signals, [&](const SampleSignal& one) {
    return one.message->id == message.id && one.info.name == signal;
  });
  return found == kind.signals.end() ? nullptr : &*found;
}

std::unique_ptr<sensors::Sensor> make_sensor(const NodeSettings& node, const Run& run) {
  const sensors::Kind& kind = *node.table().sensor;
  Run own = run;
  if (kind.of != nullptr) own.sensor = kind.key;
  auto sensor = node.is_recorded()  ? make_recorded(node, own)
                : node.is_program() ? sensors::make_program(node, own)
                                    : kind.make(node, own);
  if (run.faults != nullptr) sensor = run.faults->with_faults(std::move(sensor), node);
  return run.overrides == nullptr ? std::move(sensor)
                                  : sensors::with_overrides(std::move(sensor), kind, *run.overrides);
}

std::unique_ptr<Node> make(const NodeSettings& node, const Run& run) {
  return std::make_unique<BoundSensor>(make_sensor(node, run), kind_of(node.table()));
}

// The nodes are first ordered by what they sample (NodeTable::samples), the carrier first, then by bus
// priority (the lower id first). So a fin deflection arrives before the navigation group of the same instant
// is complete.
std::vector<std::unique_ptr<Node>> make(const Run& run) {
  std::vector<const Kind*> kinds(all().begin(), all().end());
  std::ranges::sort(kinds, {},
                    [](const Kind* kind) { return std::pair(kind->table.samples, kind->table.closes->id); });
  std::vector<std::unique_ptr<Node>> nodes;
  std::map<std::string, std::vector<const RecordedFrames*>> logs;  // those of one log share one Node
  for (const Kind* kind : kinds) {
    const auto* node = run.scenario.node(kind->table.key);
    if (node == nullptr) continue;
    const bool faulty = run.faults != nullptr && run.faults->act_on(*node);
    const auto* recorded = node->own<RecordedSettings>();
    // Frames of a log are sent unchanged, unless a fault acts on their samples.
    if (recorded != nullptr && recorded->frames && !faulty)
      logs[recorded->recorded_from].push_back(recorded->frames.get());
    else
      nodes.push_back(make(*node, run));
  }
  for (const auto& [log, frames] : logs) nodes.push_back(make_frames(frames, run));
  return nodes;
}

}  // namespace canhil::nodes
