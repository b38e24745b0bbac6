// The properties of a kind of node. Each kind defines them in its own file; all other code iterates over the
// registry or over the nodes of a scenario.
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

/// Wraps a node in the faults of a run.
class NodeFaults {
 public:
  NodeFaults() = default;
  NodeFaults(const NodeFaults&) = delete;
  NodeFaults& operator=(const NodeFaults&) = delete;
  virtual ~NodeFaults() = default;
  virtual std::unique_ptr<Node> with_faults(std::unique_ptr<Node> node, const NodeSettings& settings) = 0;
};

/// The inputs of the nodes in a run. Every object to which this struct refers must outlive the nodes.
struct Run {
  const scenario::Scenario& scenario;
  std::uint64_t index = 0;
  const world::FlightRecord& flight;              ///< from the start to the end of the run
  const world::GlideRecord* glide = nullptr;      ///< null: the scenario has no [glide]
  world::EngagementRecord* engagement = nullptr;  ///< null: no [engagement]; filled during the flight
  NodeFaults* faults = nullptr;                   ///< null: no faults

  /// A stream of random numbers. The name must never change: the results depend on it.
  [[nodiscard]] world::Stream stream(std::string_view name) const { return {scenario.seed, index, name}; }
};

/// Makes a node of type `Made`.
template <class Made>
std::unique_ptr<Node> make(const NodeSettings& node, const Run& run) {
  return std::make_unique<Made>(node, run);
}

struct Kind {
  NodeTable table;
  std::unique_ptr<Node> (*make)(const NodeSettings& node, const Run& run) = nullptr;
  /// Checks that the bus can carry every signal that the node sends in any run of a scenario; otherwise a
  /// signal could saturate or round to zero unnoticed. An error is one line of text. The pointer is null if
  /// no check is needed.
  Result<void> (*fits)(const NodeSettings& node, const scenario::Scenario& scenario,
                       const world::FlightRecord& flight) = nullptr;
  bool at_every_epoch = false;  ///< the node's period defines the epochs of the flight record
};

}  // namespace canhil::nodes
