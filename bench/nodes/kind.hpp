// What the bench has to know of a kind of node. All of it stands in the node's own file; everybody else walks
// the registry, or the nodes of a scenario.
#pragma once

#include "bench/nodes/node.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/engagement/engagement.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/glide/glide.hpp"
#include "bench/world/stream.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::nodes {

using scenario::Limits;
using scenario::NodeSettings;
using scenario::NodeTable;
using scenario::Section;

/// Makes of a node what it is in a run in which something befalls it.
class Befalling {
 public:
  Befalling() = default;
  Befalling(const Befalling&) = delete;
  Befalling& operator=(const Befalling&) = delete;
  virtual ~Befalling() = default;
  virtual std::unique_ptr<Node> befallen(std::unique_ptr<Node> node, const NodeSettings& settings) = 0;
};

/// What a run has for its nodes; all of it must outlive them.
struct Run {
  const scenario::Scenario& scenario;
  std::uint64_t index = 0;
  const world::FlightRecord& flight;              ///< ends when the run does
  const world::GlideRecord* glide = nullptr;      ///< there where [glide] is
  world::EngagementRecord* engagement = nullptr;  ///< where [engagement] is; filled as it is flown
  Befalling* faults = nullptr;                    ///< null: nothing befalls a node

  /// Random numbers. The name may never change: results hang on it.
  [[nodiscard]] world::Stream stream(std::string_view name) const { return {scenario.seed, index, name}; }
};

/// A node of type `Made`.
template <class Made>
std::unique_ptr<Node> make(const NodeSettings& node, const Run& run) {
  return std::make_unique<Made>(node, run);
}

struct Kind {
  NodeTable table;
  std::unique_ptr<Node> (*make)(const NodeSettings& node, const Run& run) = nullptr;
  /// Whether the bus can carry what it sends in any run of a scenario: a signal would saturate, or round to
  /// nothing, in silence. Error: one line. Null: it always can.
  Result<void> (*fits)(const NodeSettings& node, const scenario::Scenario& scenario,
                       const world::FlightRecord& flight) = nullptr;
  bool at_every_epoch = false;  ///< its period is that of the flight record too
};

}  // namespace canhil::nodes
