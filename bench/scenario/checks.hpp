// [[check]]: what a run is judged by. A kind of check is a file of bench/checks/kinds or of an estimator's
// folder; this folder only asks the kinds that it is given (Contract::check_kinds).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace canhil::checks {
class Rule;
}

namespace canhil::scenario {

class Section;
struct DbcVocabulary;

/// Part of a run, ends included, by the time of validity an answer names as its cause.
struct Window {
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
};

/// When a fault of the scenario is at work, by time of transmission.
struct FaultWindow {
  std::string name;
  Window window;
};

struct Check {
  std::string name;         ///< unique in the scenario; by default kind and subject: "error attitude.heading"
  std::string requirement;  ///< id carried to the reports; may be empty
  int line = 0;             ///< of the scenario file
  std::string kind;
  std::shared_ptr<const checks::Rule> rule;
};

/// What the readers of all kinds need to know of the scenario.
struct CheckContext {
  std::int64_t duration_us = 0;
  const DbcVocabulary& contract;
  std::span<const std::string> estimators;  ///< that run
  std::span<const FaultWindow> faults{};    ///< up to the end of the run
  std::int64_t latency_us = 0;              ///< the longest from validity to transmission, of all nodes
};

/// A rule, and what it looks at, if a scenario may well have several of its kind; else empty.
struct RuleRead {
  std::shared_ptr<const checks::Rule> rule;
  std::string subject;
};

struct CheckKind {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  RuleRead (*read)(Section& section, const CheckContext& context) = nullptr;
};

/// A kind that has another name now.
struct FormerCheckKind {
  std::string_view name;
  std::string_view now;  ///< what to write in its place
};

Check read_check(Section& section, const CheckContext& context);

}  // namespace canhil::scenario
