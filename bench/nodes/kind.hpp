// The nodes that the bench emulates: a sensor, and the messages of canhil.dbc that carry its samples.
#pragma once

#include <memory>

#include "bench/nodes/node.hpp"
#include "bench/nodes/sample_signals.hpp"
#include "bench/sensors/kind.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::nodes {

using scenario::Limits;
using scenario::NodeSettings;
using scenario::NodeTable;
using scenario::Section;
using sensors::Run;

struct Kind {
  NodeTable table;
  std::vector<SampleSignal> signals{};  ///< of the sample group
  /// Checks that the bus can carry every signal that the node sends in any run of a scenario; otherwise a
  /// signal could saturate or round to zero unnoticed. An error is one line of text. The pointer is null if
  /// no check is needed.
  Result<void> (*fits)(const NodeSettings& node, const scenario::Scenario& scenario,
                       const world::FlightRecord& flight) = nullptr;
};

}  // namespace canhil::nodes
