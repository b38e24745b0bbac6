// The names a scenario may use because the DBC has them, and the tables of the nodes that the bench can play.
// Given from outside, so that this folder depends neither on one bus nor on who is on it: the generated
// header or a DBC read at run time can fill it.
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

namespace canhil::estimators {
struct Estimator;
}

namespace canhil::scenario {

struct Foreign;
struct NodeTable;
class NodeSettings;
class Section;

struct DbcVocabulary {
  std::vector<std::string> estimators;  ///< value table Estimator, without "none"
  std::vector<std::string> algorithms;  ///< value table Algorithm
  std::vector<std::string> parameters;  ///< value table Parameter
  std::vector<std::string> messages;    ///< names of all messages
  std::vector<std::string> answers;     ///< of those that answer a sample group
  std::vector<CheckKind> check_kinds{};
  std::span<const estimators::Estimator* const> known{};  ///< what the bench knows of estimators
  std::vector<FormerCheckKind> former_check_kinds{};
  /// By message, the estimator that sends it. Not there: sent whoever runs, or not by the target.
  std::map<std::string, std::string, std::less<>> sent_by{};
  std::map<std::string, EstimatorFacts, std::less<>> facts{};  ///< by estimator
  std::vector<const NodeTable*> nodes{};                       ///< in the order in which they are read
  std::vector<FaultKind> fault_kinds{};
  std::shared_ptr<const Foreign> foreign{};  ///< null: the target speaks the project's own contract
  /// Reads the table of any node that has a key `recorded`; null: none may.
  NodeSettings (*read_recorded)(const NodeTable& table, Section& section, std::int64_t duration_us) = nullptr;
};

/// Of an estimator; one that nobody knows is one that navigates.
inline EstimatorFacts facts_of(const DbcVocabulary& contract, std::string_view estimator) {
  const auto found = contract.facts.find(estimator);
  return found == contract.facts.end() ? EstimatorFacts{} : found->second;
}

}  // namespace canhil::scenario
