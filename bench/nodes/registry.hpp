// The kinds of nodes that the bench can play.
#pragma once

#include <span>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/nodes/recorded.hpp"

namespace canhil::nodes {

/// All of them, in the order in which tables are read and reports tell of them.
std::span<const Kind* const> all();

/// Their tables, for scenario::DbcVocabulary.
std::vector<const scenario::NodeTable*> tables();

/// One of them, emulated or recorded, by itself.
std::unique_ptr<Node> make(const Kind& kind, const NodeSettings& node, const Run& run);

/// The nodes of a run in the order of precedence.
std::vector<std::unique_ptr<Node>> make(const Run& run);

}  // namespace canhil::nodes
