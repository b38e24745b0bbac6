// Functions for the kinds of checks that judge the response to a fault.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/checks/rule.hpp"
#include "bench/checks/signs.hpp"

namespace canhil::checks {

/// A disturbed interval of the run: a fault of the scenario, or an event whose time the check gives.
struct Disturbance {
  std::string fault;        ///< name of the fault; empty: the check gives times
  scenario::Window window;  ///< by time of transmission
  /// The earliest time of validity that the disturbance can affect. It may lie before the window, because
  /// nodes measure before they send.
  std::int64_t valid_from_us = 0;
  [[nodiscard]] std::string to_text() const;  ///< "fault 'NAME'", "10 s"
  /// The time of the disturbance, if it is not a fault of the scenario.
  [[nodiscard]] std::optional<std::int64_t> event_us() const {
    return fault.empty() ? std::optional(window.from_us) : std::nullopt;
  }
};

/// The fault whose name is the value of the key `fault`; none: the key is absent. Error: an unknown name; the
/// message lists the known names.
std::optional<Disturbance> read_fault(scenario::Section& section, const scenario::CheckContext& context);

/// Reads the key `fault` or, if it is absent, the key `from_s`, which is the time of a disturbance.
Disturbance read_disturbance(scenario::Section& section, const scenario::CheckContext& context);

/// Reads `within_s` and returns it. `meaning`: text for the reference. Error: the sum of `after_us` and
/// `within_s` lies after the end of the run.
std::int64_t read_within(scenario::Section& section, const scenario::CheckContext& context,
                         std::int64_t after_us, std::string_view meaning);

/// Reads the key `by`: the names of the signs that count. Empty: every sign counts that was absent just
/// before the onset.
std::vector<std::string> read_signs(scenario::Section& section, const scenario::CheckContext& context);

/// The signs of a disturbance.
struct SignsOf {
  std::vector<Sign> fresh{};                     ///< signs that did not appear just before the disturbance
  std::vector<Sign> there_before{};              ///< the other signs, which cannot show the disturbance
  [[nodiscard]] std::string why_hidden() const;  ///< "already present before it: degraded in an answer"
};
/// The signs of these names; without names, all signs.
SignsOf signs_of(const Evidence& evidence, const Disturbance& of, const std::vector<std::string>& names);

/// Why the response to a disturbance cannot be measured: its fault did not strike, or the target cannot show
/// signs. Empty: it can be measured.
std::string not_measurable(const Evidence& evidence, const Disturbance& of);
/// "the fault 'NAME' did not strike". Empty: it struck, or the scenario has no such fault.
std::string did_not_strike(const Evidence& evidence, std::string_view fault);

/// The estimators that run in this scenario and that the bench knows.
std::vector<const estimators::Estimator*> running(const scenario::CheckContext& context);

/// The quantities that every answer reports: no norms, innovations, NEES or NIS. The tracks of these
/// quantities show whether the estimator still answers.
std::vector<Subject> always_reported(const estimators::Estimator& estimator);

/// Reports the first quantity that has no answers in some part of the window, and reports this part. Empty:
/// there is no such quantity. If the window is not longer than the longest regular wait for an answer,
/// missing answers do not count as silence.
std::string silence_of(const Evidence& evidence, const std::vector<Subject>& subjects,
                       const scenario::Window& window);

}  // namespace canhil::checks
