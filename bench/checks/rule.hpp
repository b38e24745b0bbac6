// A rule of a scenario, and the parts of a kind of check.
//
// A kind is a struct with a constant `kind`, a constant `meaning` (for the reference), its fields, and
//   static Kind read(scenario::Section&, const scenario::CheckContext&)
//   Finding judge(const Evidence&) const         an absent answer counts as a failure of the target; the
//                                                limits are in Finding::expected, the value in
//                                                Finding::measurement
// and, where they apply,
//   std::string subject() const                  a text that distinguishes the checks of one kind
//   std::vector<Subject> subjects() const        the quantities that the rule uses
//   std::vector<std::string> held_against_truth() const
//                                                the estimators whose truth the rule needs; without this
//                                                function: the estimators of all subjects that are not
//                                                innovations
//   std::vector<std::string> needs_answers_of() const
//                                                the estimators whose answers must not be missing; without
//                                                this function: the estimators of all subjects
//   Stretch span() const                         where these answers must not be missing; without this
//                                                function: `stretch` or `window` or, if the kind has
//                                                neither, the whole run
//   std::optional<std::int64_t> event_us() const  the time of an event outside the scenario
//   std::vector<Subject> paired() const          the quantities whose answers must have certain causes;
//                                                without this function: all subjects
//   std::optional<Bar> bar() const               the limits of the rule, for pictures
//   std::vector<Timed> timed() const             the messages whose times the rule needs, with windows
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/finding.hpp"
#include "bench/quantities/quantity.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

class Condition;
struct Evidence;

/// A quantity of an estimator.
struct Subject {
  std::string estimator;
  const quantities::Quantity* quantity = nullptr;
  std::string text{};  ///< "attitude.heading"; if several estimators report the quantity, followed by the
                       ///< estimator
};

/// The estimators of the subjects for which wanted(subject) holds, each once.
template <class Wanted>
std::vector<std::string> estimators_of(const std::vector<Subject>& subjects, Wanted wanted) {
  std::vector<std::string> estimators;
  for (const Subject& subject : subjects) {
    if (wanted(subject) && std::ranges::find(estimators, subject.estimator) == estimators.end())
      estimators.push_back(subject.estimator);
  }
  return estimators;
}

/// The limit |quantity| < below.
struct Bar {
  std::vector<Subject> judged;
  Stretch stretch;
  double below = 0;  ///< [SI]
  std::string_view statistic{};
};

struct Timed {
  std::string message;
  scenario::Window window;
};

class Rule {
 public:
  Rule() = default;
  Rule(const Rule&) = delete;
  Rule& operator=(const Rule&) = delete;
  virtual ~Rule() = default;

  [[nodiscard]] virtual Finding judge(const Evidence& evidence) const = 0;
  [[nodiscard]] virtual std::vector<Subject> subjects() const = 0;
  [[nodiscard]] virtual const Condition* condition() const = 0;
  [[nodiscard]] virtual std::vector<std::string> held_against_truth() const = 0;
  [[nodiscard]] virtual std::vector<std::string> needs_answers_of() const = 0;
  [[nodiscard]] virtual Stretch span() const = 0;
  [[nodiscard]] virtual std::optional<std::int64_t> event_us() const = 0;
  [[nodiscard]] virtual std::vector<Subject> paired() const = 0;
  [[nodiscard]] virtual std::optional<Bar> bar() const = 0;
  [[nodiscard]] virtual std::vector<Timed> timed() const = 0;
};

template <class Kind>
class RuleOf final : public Rule {
 public:
  explicit RuleOf(Kind kind) : kind_(std::move(kind)) {}
  [[nodiscard]] Finding judge(const Evidence& evidence) const override { return kind_.judge(evidence); }
  [[nodiscard]] std::vector<Subject> subjects() const override {
    if constexpr (requires { kind_.subjects(); }) return kind_.subjects();
    return {};
  }
  [[nodiscard]] const Condition* condition() const override {
    if constexpr (requires { kind_.stretch; }) return kind_.stretch.condition.get();
    if constexpr (requires { kind_.condition; }) return kind_.condition.get();
    return nullptr;
  }
  [[nodiscard]] std::vector<std::string> held_against_truth() const override {
    if constexpr (requires { kind_.held_against_truth(); })
      return kind_.held_against_truth();
    else
      return estimators_of(subjects(), [](const Subject& subject) { return !subject.quantity->white; });
  }
  [[nodiscard]] std::vector<std::string> needs_answers_of() const override {
    if constexpr (requires { kind_.needs_answers_of(); })
      return kind_.needs_answers_of();
    else
      return estimators_of(subjects(), [](const Subject&) { return true; });
  }
  [[nodiscard]] Stretch span() const override {
    if constexpr (requires { kind_.span(); }) return kind_.span();
    if constexpr (requires { kind_.stretch; }) return kind_.stretch;
    if constexpr (requires { kind_.window; }) return {.window = kind_.window};
    return {.window = {.from_us = 0, .to_us = std::numeric_limits<std::int64_t>::max()}};
  }
  [[nodiscard]] std::optional<std::int64_t> event_us() const override {
    if constexpr (requires { kind_.event_us(); }) return kind_.event_us();
    return std::nullopt;
  }
  [[nodiscard]] std::vector<Subject> paired() const override {
    if constexpr (requires { kind_.paired(); }) return kind_.paired();
    return subjects();
  }
  [[nodiscard]] std::optional<Bar> bar() const override {
    if constexpr (requires { kind_.bar(); }) return kind_.bar();
    return std::nullopt;
  }
  [[nodiscard]] std::vector<Timed> timed() const override {
    if constexpr (requires { kind_.timed(); }) return kind_.timed();
    return {};
  }
  [[nodiscard]] const Kind& kind() const { return kind_; }

 private:
  Kind kind_;
};

template <class Kind>
scenario::RuleRead read_rule(scenario::Section& section, const scenario::CheckContext& context) {
  Kind rule = Kind::read(section, context);
  std::string subject;
  if constexpr (requires { rule.subject(); }) subject = rule.subject();
  return {std::make_shared<RuleOf<Kind>>(std::move(rule)), std::move(subject)};
}

/// The entry of a kind of check in the list of kinds.
template <class Kind>
inline constexpr scenario::CheckKind check_kind{
    .name = Kind::kind, .meaning = Kind::meaning, .read = read_rule<Kind>};

}  // namespace canhil::checks
