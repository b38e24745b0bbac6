// The rules of the protocol. Every target must follow these rules, whatever the target estimates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/conformance/talk.hpp"

namespace canhil::conformance {

/// A parameter of the target, and the range of values that the target must accept for it before the start.
struct Parameter {
  std::string name;
  double least = 0, most = 0;
  bool whole = false;
  bool in_flight = false;  ///< may be set while the estimator runs
};

/// A flight without faults, for comparison.
struct Undisturbed {
  std::vector<Frame> heard;
  std::string_view sample;  ///< name of the sample group that is answered most often
  std::size_t index =
      0;               ///< index of an answered sample in mid-flight, counted among the samples of this group
  double time_us = 0;  ///< time of validity of the sample at `index`
};

/// The target under test, and what is known about its parameters.
struct Subject {
  Talk& talk;
  std::span<const Parameter> parameters{};                ///< all parameters of the target; empty: unknown
  std::optional<std::pair<std::string, double>> apply{};  ///< name of a parameter whose change takes effect
                                                          ///< in flight, and a value for it; none: unknown
  std::optional<Undisturbed> undisturbed{};               ///< none: not flown yet
};

enum class Needs : std::uint8_t { nothing, parameters, apply };

struct Rule {
  const char* id;
  const char* family;  ///< "protocol" or "parameters"
  const char* text;    ///< the rule, as a sentence for people
  /// Tests the rule. Returns a description of the violation; an empty string: the target follows the rule.
  std::string (*ask)(Subject& subject);
  Needs needs = Needs::nothing;
};

std::span<const Rule> handshake_rules();
std::span<const Rule> flight_rules();
std::span<const Rule> fault_rules();
std::span<const Rule> parameter_rules();
/// Returns all rules that can be tested. `parameters_known` means that Subject::parameters is given,
/// `apply_known` that Subject::apply is given.
std::vector<Rule> rules(bool parameters_known, bool apply_known);

inline constexpr std::int64_t flight_us = 1'000'000, some_flight_us = 500'000;

/// Sends a reset, the initial state and a start. Returns a description of the violation; an empty string:
/// none.
std::string made_to_run(Subject& subject);
/// Calls made_to_run(), flies for some_flight_us and expects answers. Returns a description of the violation;
/// an empty string: none.
std::string flies(Subject& subject);
/// Formats the state, estimator, algorithm and errors of a heartbeat for people:
/// "state running, transfer_alignment kalman, errors: none".
std::string described(const std::optional<messages::TargetHeartbeat>& beat);

/// Returns the flight without faults; the first call flies it. Returns an error if the target does not start,
/// or answers too few samples.
Result<const Undisturbed*> undisturbed(Subject& subject);

}  // namespace canhil::conformance
