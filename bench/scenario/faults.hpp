// [[fault]]: what goes wrong in a run on purpose: in a sensor, in a node, on the bus, in the target. A kind
// of fault is a file of bench/faults/kinds; this folder only asks the kinds that it is given
// (Contract::fault_kinds).
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
  std::string name{};  ///< unique in the scenario; by default kind and what it befalls
  std::string kind{};
  std::int64_t from_us = 0, to_us = std::numeric_limits<std::int64_t>::max();  ///< times of transmission
  std::string where{};  ///< "file:line: key 'fault[1]'", for people
  std::shared_ptr<const faults::Rule> rule{};
};

/// What the readers of all kinds need to know of the scenario.
struct FaultContext {
  std::int64_t duration_us = 0;
  const DbcVocabulary& contract;
  std::span<const NodeSettings> nodes;  ///< that are on the bus
};

/// A rule, when it is at work, and what it befalls: what tells one fault of the kind from another.
struct FaultRead {
  std::shared_ptr<const faults::Rule> rule;
  std::int64_t from_us = 0, to_us = std::numeric_limits<std::int64_t>::max();
  std::string subject{};
};

struct FaultKind {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  FaultRead (*read)(Section& section, const FaultContext& context) = nullptr;
};

/// Which of a file's [[fault]] tables, counted from 0: those of a row of a set, which may name the row by the
/// key `together`.
using FaultPlaces = std::vector<std::size_t>;

/// Appends the faults of a file's root, or some of them, to those before.
void read_faults(Section& root, const FaultContext& context, std::vector<Fault>& faults,
                 const FaultPlaces* some = nullptr);

}  // namespace canhil::scenario
