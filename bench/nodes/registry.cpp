// One line for each node.
#include "bench/nodes/registry.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "bench/nodes/fins.hpp"
#include "bench/nodes/glider_nav.hpp"
#include "bench/nodes/gps.hpp"
#include "bench/nodes/master_ins.hpp"
#include "bench/nodes/seeker.hpp"
#include "bench/nodes/slave_imu.hpp"
#include "bench/nodes/ssbl.hpp"

namespace canhil::nodes {
namespace {

constexpr std::array registered{
    &master_ins,  // of the carrier
    &slave_imu,   // of the weapon, or of the vehicle
    &ssbl,        // of a ship
    &gps,         // of the vehicle
    &seeker,      // of a missile
    &glider_nav,  // the GPS/INS of the glider
    &fins,        // of the glider
};

}  // namespace

std::span<const Kind* const> all() { return registered; }

std::vector<const scenario::NodeTable*> tables() {
  std::vector<const scenario::NodeTable*> all;
  for (const Kind* kind : registered) all.push_back(&kind->table);
  return all;
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
  auto kinds = registered;
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
