// One line for each node.
#include "bench/nodes/registry.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "bench/nodes/fits.hpp"
#include "bench/sensors/fins.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/sensors/gps.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/seeker.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/sensors/ssbl.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {
namespace {

// A sensor and the last message of its sample group.
Kind bind(const sensors::Kind& sensor, const MessageInfo& closes, decltype(Kind::fits) fits = nullptr) {
  return {.table = {.key = sensor.key,
                    .closes = closes,
                    .samples = sensor.samples,
                    .read = sensor.read,
                    .aid = sensor.aid,
                    .assumed = sensor.assumed,
                    .increments = sensor.increments},
          .sensor = &sensor,
          .fits = fits};
}

const auto& kinds() {
  using namespace messages;
  static const std::array registered{
      bind(sensors::master_ins, MasterInsVelocityD::info),             // of the carrier
      bind(sensors::slave_imu, SlaveImuStatus::info, slave_imu_fits),  // of the weapon, or of the vehicle
      bind(sensors::ssbl, SsblRelativeD::info),                        // of a ship
      bind(sensors::gps, GpsTime::info),                               // of the vehicle
      bind(sensors::seeker, SeekerRange::info, seeker_fits),           // of a missile
      bind(sensors::glider_nav, GliderNavVelocityD::info),             // the GPS/INS of the glider
      bind(sensors::fins, FinDeflections::info),                       // of the glider
  };
  return registered;
}

}  // namespace

std::span<const Kind* const> all() {
  static const auto pointers = [] {
    std::array<const Kind*, std::tuple_size_v<std::remove_cvref_t<decltype(kinds())>>> all{};
    std::ranges::transform(kinds(), all.begin(), [](const Kind& kind) { return &kind; });
    return all;
  }();
  return pointers;
}

const Kind& bound(const sensors::Kind& sensor) { return **std::ranges::find(all(), &sensor, &Kind::sensor); }

const Kind& kind_of(const NodeTable& table) {
  return **std::ranges::find(all(), table.key, [](const Kind* kind) { return kind->table.key; });
}

std::vector<const scenario::NodeTable*> tables() {
  std::vector<const scenario::NodeTable*> tables;
  for (const Kind* kind : all()) tables.push_back(&kind->table);
  return tables;
}

std::unique_ptr<Node> make(const Kind& kind, const NodeSettings& node, const Run& run) {
  const auto* recorded = node.own<RecordedSettings>();
  auto made = recorded == nullptr ? kind.make(node, run)
              : recorded->samples ? make_samples(node, run)
                                  : make_frames({recorded->frames.get()}, run);
  return run.faults == nullptr ? std::move(made) : run.faults->with_faults(std::move(made), node);
}

// The nodes are first ordered by the truth that they sample (TruthOf), then by bus priority (the lower id
// first). So a fin deflection arrives before the navigation group of the same instant is complete.
std::vector<std::unique_ptr<Node>> make(const Run& run) {
  std::vector<const Kind*> kinds(all().begin(), all().end());
  std::ranges::sort(kinds, {},
                    [](const Kind* kind) { return std::pair(kind->table.samples, kind->table.closes.id); });
  std::vector<std::unique_ptr<Node>> nodes;
  std::map<std::string, std::vector<const NodeSettings*>> logs;
  for (const Kind* kind : kinds) {
    const auto* node = run.scenario.node(kind->table.key);
    if (node == nullptr) continue;
    const auto* recorded = node->own<RecordedSettings>();
    if (recorded != nullptr && recorded->frames)  // the nodes of one log share one Node
      logs[recorded->recorded_from].push_back(node);
    else
      nodes.push_back(make(*kind, *node, run));
  }
  for (const auto& [log, of_it] : logs) {
    std::vector<const RecordedFrames*> frames;
    for (const NodeSettings* node : of_it) frames.push_back(node->own<RecordedSettings>()->frames.get());
    auto made = make_frames(frames, run);
    for (const NodeSettings* node : of_it)
      if (run.faults != nullptr) made = run.faults->with_faults(std::move(made), *node);
    nodes.push_back(std::move(made));
  }
  return nodes;
}

}  // namespace canhil::nodes
