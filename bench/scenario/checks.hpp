// Reads [[check]]: the criteria for a run. Each kind of check is implemented in a file of
// bench/checks/kinds or of an estimator's folder; bench/scenario only uses the kinds that it receives
// (DbcVocabulary::check_kinds).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/plant_facts.hpp"

namespace canhil::checks {
class Rule;
}

namespace canhil::scenario {

class Section;
struct DbcVocabulary;

/// A part of a run; both ends belong to it. An answer belongs to the window that contains the time of
/// validity of the answer's cause.
struct Window {
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
};

/// The interval in which a fault of the scenario is active. The interval refers to times of transmission, not
/// to times of validity.
struct FaultWindow {
  std::string name;
  Window window;
};

struct Check {
  std::string name;         ///< unique in the scenario; by default kind and subject: "error attitude.heading"
  std::string requirement;  ///< id for the reports; may be empty
  int line = 0;             ///< line in the scenario file
  std::string kind;
  std::shared_ptr<const checks::Rule> rule;
};

/// A [[check]] without the key `estimator` becomes a check of each estimator that it can judge. It is read
/// once for each of them.
struct EachEstimator {
  std::size_t index = 0;    ///< which of the estimators
  std::size_t number = 1;   ///< how many there are; set by the reader of the check
  std::string estimator{};  ///< its name, if there are several; set by the reader of the check
};

inline const PlantFacts no_plant{};

/// Facts about the scenario, for the functions that read the different kinds of checks.
struct CheckContext {
  std::int64_t duration_us = 0;
  const DbcVocabulary& contract;
  std::span<const std::string> estimators;  ///< the estimators that run
  const PlantFacts& plant = no_plant;
  std::span<const FaultWindow> faults{};  ///< the windows end with the run at the latest
  std::span<const std::string> events{};  ///< names of the scenario's events
  std::int64_t latency_us = 0;            ///< largest latency of a node, from validity to transmission
  EachEstimator* each = nullptr;          ///< null: only the first of the estimators is read
};

/// A rule and its subject. The subject is empty for a kind that a scenario may have only once.
struct RuleRead {
  std::shared_ptr<const checks::Rule> rule;
  std::string subject;
};

struct CheckKind {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  RuleRead (*read)(Section& section, const CheckContext& context) = nullptr;
};

/// Reads a [[check]]: one check or, without the key `estimator`, a check of each estimator that it can judge.
std::vector<Check> read_check(Section& section, CheckContext context);

}  // namespace canhil::scenario
