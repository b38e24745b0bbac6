// Reads [[fault]]: deliberate faults of a sensor, a node, the bus or the target. The kinds are in
// bench/faults/kinds; this folder only uses the kinds that it receives (DbcVocabulary::fault_kinds).
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::faults {
class Rule;
}

namespace canhil::scenario {

class NodeSettings;
class Section;
struct DbcVocabulary;

struct Fault {
  std::string name{};  ///< unique in the scenario; by default kind and subject
  std::string kind{};
  std::int64_t from_us = 0, to_us = std::numeric_limits<std::int64_t>::max();  ///< times of transmission
  bool begins_in_run = false;  ///< by a condition or a command: its times are known only after the run
  std::string where{};         ///< for messages: "file:line: key 'fault[1]'"
  std::shared_ptr<const faults::Rule> rule{};
};

/// Facts about the scenario, for the functions that read the different kinds of faults.
struct FaultContext {
  std::int64_t duration_us = 0;
  const DbcVocabulary& contract;
  std::span<const NodeSettings> nodes;  ///< the nodes on the bus
};

/// A rule, the time when it is active, and its subject, which distinguishes faults of one kind.
struct FaultRead {
  std::shared_ptr<const faults::Rule> rule;
  std::int64_t from_us = 0, to_us = std::numeric_limits<std::int64_t>::max();
  bool begins_in_run = false;
  std::string subject{};
};

struct FaultKind {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  FaultRead (*read)(Section& section, const FaultContext& context) = nullptr;
};

/// Indices (from 0) of some [[fault]] tables in a file. They form one row of a set of faults: a single table,
/// or the tables with the same value of the key `together`.
using FaultPlaces = std::vector<std::size_t>;

/// Appends all faults of a file, or some of them.
void read_faults(Section& root, const FaultContext& context, std::vector<Fault>& faults,
                 const FaultPlaces* some = nullptr);

}  // namespace canhil::scenario
