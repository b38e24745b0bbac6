// The kinds of nodes that the bench can emulate.
#pragma once

#include <span>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/nodes/recorded.hpp"

namespace canhil::nodes {

/// All kinds, in the order in which tables are read and reported.
std::span<const Kind* const> all();

/// The kind that binds this sensor.
const Kind& bound(const sensors::Kind& sensor);
/// The kind that has this table.
const Kind& kind_of(const NodeTable& table);

/// The tables of all kinds, for scenario::DbcVocabulary.
std::vector<const scenario::NodeTable*> tables();

/// One node alone, emulated or recorded.
std::unique_ptr<Node> make(const Kind& kind, const NodeSettings& node, const Run& run);

/// The nodes of a run in order of precedence.
std::vector<std::unique_ptr<Node>> make(const Run& run);

}  // namespace canhil::nodes
