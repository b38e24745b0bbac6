// The rules of the protocol that every target owes, whatever it estimates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/conformance/talk.hpp"

namespace canhil::conformance {

/// A parameter as it is sent over the bus, before the start.
struct Parameter {
  std::string name;
  double least = 0, most = 0;
  bool whole = false;
  bool in_flight = false;  ///< may be set while the estimator runs
};

/// A flight without faults, to hold others against.
struct Undisturbed {
  std::vector<Frame> heard;
  std::string_view sample;  ///< the sample group that is answered most often
  std::size_t index = 0;    ///< among its samples, of one in the middle that is answered
  double time_us = 0;       ///< of validity, of that one
};

/// A target that is asked, and what is known of it.
struct Subject {
  Talk& talk;
  std::span<const Parameter> parameters{};                ///< all that it has; empty: not known
  std::optional<std::pair<std::string, double>> apply{};  ///< one that takes effect in flight
  std::optional<Undisturbed> undisturbed{};               ///< once it has been flown
};

enum class Needs : std::uint8_t { nothing, parameters, apply };

struct Rule {
  const char* id;
  const char* family;  ///< protocol or parameters
  const char* text;    ///< a sentence
  /// What was wrong; empty: nothing.
  std::string (*ask)(Subject& subject);
  Needs needs = Needs::nothing;
};

std::span<const Rule> handshake_rules();
std::span<const Rule> flight_rules();
std::span<const Rule> fault_rules();
std::span<const Rule> parameter_rules();
/// Those of all four that can be asked of a target of which the parameters, or one to apply, are known.
std::vector<Rule> rules(bool parameters_known, bool apply_known);

inline constexpr std::int64_t flight_us = 1'000'000, some_flight_us = 500'000;

/// A reset, the initial state, a start; what was wrong.
std::string made_to_run(Subject& subject);
/// The same, and flies for some_flight_us: answers come.
std::string flies(Subject& subject);
/// "state idle, none kalman, errors: none", for people.
std::string described(const std::optional<messages::TargetHeartbeat>& beat);

/// The flight without faults; flown when it is asked for first. Error: it cannot be flown.
Result<const Undisturbed*> undisturbed(Subject& subject);

}  // namespace canhil::conformance
