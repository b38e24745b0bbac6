// The names that a scenario may use because the DBC defines them, and the tables of the nodes that the bench
// can emulate. The caller provides both, from the generated header or from a DBC that is read at run time, so
// this folder does not depend on a particular bus or its nodes.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/scenario/checks.hpp"
#include "bench/scenario/estimator_facts.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/scenario/plant_facts.hpp"

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::scenario {

struct Binding;
struct NodeTable;
class NodeSettings;
class Section;

struct DbcVocabulary {
  std::vector<std::string> estimators{};  ///< those that the target may run
  std::vector<std::string> algorithms{};  ///< value table Algorithm
  std::vector<std::string> parameters{};  ///< value table Parameter
  std::vector<std::string> messages{};    ///< names of all messages
  std::vector<std::string> answers{};     ///< names of the messages that answer a sample group
  std::vector<CheckKind> check_kinds{};
  std::span<const estimators::Estimator* const> known{};  ///< the estimators known to the bench
  /// For each message: the only estimator that sends this message. Without an entry, every target sends the
  /// message, or no target does.
  std::map<std::string, std::string, std::less<>> sent_by{};
  std::map<std::string, EstimatorFacts, std::less<>> facts{};  ///< by estimator
  std::vector<const NodeTable*> nodes{};                       ///< in the order in which they are read
  std::vector<FaultKind> fault_kinds{};
  std::shared_ptr<const Binding> binding{};
  /// Reads the table of any node if the table has the key `recorded`; null: recordings are not allowed.
  NodeSettings (*read_recorded)(const NodeTable& table, Section& section, std::int64_t duration_us) = nullptr;
  /// Reads the table of any sensor if it has the key `command`.
  NodeSettings (*read_program)(const NodeTable& table, Section& section) = nullptr;
  /// The plants with tables of their own, in the order in which they are read.
  std::span<const PlantTable* const> plants{};
  /// Reads the table [plant]; null: a scenario has none.
  PlantFacts (*read_plant)(Section& section, const Binding& binding) = nullptr;
  /// The table of a sensor with a name of its own; `kind`: the table of its kind. Null: the binding declares
  /// no sensor of this name, and the kind needs it.
  const NodeTable* (*named)(const NodeTable& kind, std::string_view name, const Binding& binding) = nullptr;
};

/// The facts of an estimator; an unknown estimator is assumed to navigate.
inline EstimatorFacts facts_of(const DbcVocabulary& contract, std::string_view estimator) {
  const auto found = contract.facts.find(estimator);
  return found == contract.facts.end() ? EstimatorFacts{} : found->second;
}

}  // namespace canhil::scenario
