// The nodes that the bench emulates: a sensor, and the messages of canhil.dbc that carry its samples.
#pragma once

#include <memory>

#include "bench/nodes/node.hpp"
#include "bench/sensors/kind.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::nodes {

using scenario::Limits;
using scenario::NodeSettings;
using scenario::NodeTable;
using scenario::Section;
using sensors::Run;

/// Wraps a node in the faults of a run.
class NodeFaults {
 public:
  NodeFaults() = default;
  NodeFaults(const NodeFaults&) = delete;
  NodeFaults& operator=(const NodeFaults&) = delete;
  virtual ~NodeFaults() = default;
  virtual std::unique_ptr<Node> with_faults(std::unique_ptr<Node> node, const NodeSettings& settings) = 0;
};

struct Kind {
  NodeTable table;
  const sensors::Kind* sensor = nullptr;
  /// Checks that the bus can carry every signal that the node sends in any run of a scenario; otherwise a
  /// signal could saturate or round to zero unnoticed. An error is one line of text. The pointer is null if
  /// no check is needed.
  Result<void> (*fits)(const NodeSettings& node, const scenario::Scenario& scenario,
                       const world::FlightRecord& flight) = nullptr;

  /// Makes the node that measures and sends.
  [[nodiscard]] std::unique_ptr<Node> make(const NodeSettings& node, const Run& run) const;
};

}  // namespace canhil::nodes
