// A small valid scenario, and functions to change it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "bench/bindings/canhil.hpp"
#include "bench/checks/judge.hpp"
#include "bench/checks/rule.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/estimators/vocabulary.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/plant/registry.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::scenario {

inline const DbcVocabulary contract{.estimators = {"transfer_alignment", "inflight_alignment", "los_rate"},
                                    .algorithms = {"kalman", "robust_h2"},
                                    .parameters = {"accel_bias_sigma_ug", "h2_case", "velocity_noise_m2ps"},
                                    .messages = {"AlignAttitude", "AlignUpdate", "TargetHeartbeat"},
                                    .answers = {"AlignAttitude", "AlignUpdate"},
                                    .check_kinds = checks::kinds(estimators::all()),
                                    .known = estimators::all(),
                                    .facts = estimators::bound_to({}, bindings::canhil()).facts,
                                    .nodes = nodes::tables(),
                                    .binding = bindings::canhil(),
                                    .plants = plant::tables()};

inline constexpr std::string_view valid = R"(title = "A title"
duration_s = 20.0
seed = 7
[target]
estimator = "transfer_alignment"
algorithm = "kalman"
initial_sigma = { velocity_mps = 1.0, tilt_deg = 2.0, heading_deg = 5.0, position_m = 10.0 }
[truth]
trajectory = "rest"
latitude_deg = 37.0
longitude_deg = 127.0
height_m = 1000.0
heading_deg = 90
[master_ins]
[slave_imu]
[[check]]
kind = "heartbeat"
silent_at_most_s = 0.5
)";

/// `text` with the first occurrence of `from` replaced.
inline std::string with(std::string_view from, std::string_view to, std::string_view text = valid) {
  std::string changed(text);
  const std::size_t at = changed.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the text has no '" << from << "'";
    return changed;
  }
  return changed.replace(at, from.size(), to);
}

/// `valid` with lines inserted after its table header [section].
inline std::string inside(std::string_view section, std::string_view lines) {
  return with(section, std::string(section) + "\n" + std::string(lines));
}

inline Scenario parsed(std::string_view text) {
  const Result<Scenario> result = parse(text, "s.toml", contract);
  if (result) return *result;
  ADD_FAILURE() << result.error().message;
  return {};
}

/// The rule of a check that is known to be of this kind.
template <class Kind>
Kind rule_of(const Check& check) {
  const auto* rule = dynamic_cast<const checks::RuleOf<Kind>*>(check.rule.get());
  if (rule != nullptr) return rule->kind();
  ADD_FAILURE() << "not the kind expected";
  return {};
}

inline std::string error_of(std::string_view text) {
  const Result<Scenario> result = parse(text, "s.toml", contract);
  return result ? "no error" : result.error().message;
}

/// The settings of the node whose settings have this type.
template <class Settings>
Settings node_of(const Scenario& scenario) {
  for (const NodeSettings& node : scenario.nodes) {
    if (const auto* settings = node.own<Settings>()) return *settings;
  }
  ADD_FAILURE() << "it is not there";
  return {};
}

}  // namespace canhil::scenario
