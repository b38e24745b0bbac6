// What kinds of checks that look at the response to a fault have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/rule.hpp"
#include "bench/checks/signs.hpp"

namespace canhil::checks {

/// A stretch in which something is wrong: a fault of the scenario, or times that the check gives.
struct Disturbance {
  std::string fault;        ///< its name; empty: the check gives times
  scenario::Window window;  ///< by time of transmission
  /// The first time of validity that it can befall: nodes send later than they measure.
  std::int64_t valid_from_us = 0;
  [[nodiscard]] std::string to_text() const;  ///< "fault 'NAME'", "10 s"
};

/// The fault of the scenario that `fault` names; none: the key is not there. Error: an unknown name, with
/// those that there are.
std::optional<Disturbance> read_fault(scenario::Section& section, const scenario::CheckContext& context);

/// `fault`, or a moment of trouble, `from_s`.
Disturbance read_disturbance(scenario::Section& section, const scenario::CheckContext& context);

/// `within_s` after a time. Error: that is after the end of the run.
std::int64_t read_within(scenario::Section& section, const scenario::CheckContext& context,
                         std::int64_t after_us);

/// `by`: names of signs; empty: any.
std::vector<std::string> read_signs(scenario::Section& section, const scenario::CheckContext& context);

/// Those of the names; without names, those that were not given just before the disturbance.
std::vector<Sign> signs_of(const Evidence& evidence, const Disturbance& of,
                           const std::vector<std::string>& names);

/// The estimators that run, of those that are known.
std::vector<const estimators::Estimator*> running(const scenario::CheckContext& context);

/// The quantities whose tracks tell whether an estimator still answers: errors, as they are told with every
/// answer.
std::vector<Subject> always_reported(const estimators::Estimator& estimator);

/// What is silent, and when, in a stretch; empty: nothing is. A stretch that is no longer than any wait for
/// an answer has no silence.
std::string silence_of(const Evidence& evidence, const std::vector<Subject>& subjects,
                       const scenario::Window& window);

}  // namespace canhil::checks
