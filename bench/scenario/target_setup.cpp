#include "bench/scenario/target_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/scenario/initial_error.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

InitialSigma read_initial_sigma(Section section, const TargetSetup& target) {
  const InitialSigma sigma{.velocity = section.number("velocity_mps", Limits::above(0)),
                           .tilt = section.number("tilt_deg", Limits::above(0, 90)),
                           .heading = section.number("heading_deg", Limits::above(0, 600)),
                           .position = section.number("position_m", Limits::above(0))};
  constexpr double half_turn = 180 * world::units::deg;
  if (sigma.heading > half_turn && target.algorithm != "sin_cos")
    section.reject("heading_deg", "is more than a heading can be wrong by",
                   "at most 180, or algorithm sin_cos");
  section.finish();
  return sigma;
}

std::vector<Parameter> read_parameters(Section section, const Contract& contract,
                                       const std::string& estimator) {
  const auto own = contract.parameters_of.find(estimator);
  const auto may_be_meant = [&](const std::string& name) {
    return own == contract.parameters_of.end() || std::ranges::find(own->second, name) != own->second.end();
  };
  constexpr double largest = 3.4e38;  // ParamSet carries an IEEE single
  std::vector<Parameter> parameters;
  for (const std::string& name : contract.parameters) {
    const bool given =
        section.has(name);  // one of another estimator may be the target's too: that refuses it
    if (!given && !may_be_meant(name)) continue;
    const double value = section.plain_number(name, Limits::between(-largest, largest), 0.0);
    if (!given) continue;
    parameters.push_back({.name = name,
                          .value = value,
                          .where = fmt::format("{}: key '{}'", section.where(name), section.path(name))});
  }
  section.finish();
  return parameters;
}

TargetSetup read_target(Section& section, const Contract& contract) {
  TargetSetup target;
  target.estimator = section.one_of("estimator", contract.estimators);
  target.algorithm = section.one_of("algorithm", contract.algorithms);
  target.algorithm_where = fmt::format("{}: key '{}'", section.where("algorithm"), section.path("algorithm"));
  // Told at every start; an estimator that does not navigate makes nothing of it.
  const bool navigates = target.estimator != "los_rate";
  if (navigates || section.has("initial_sigma"))
    target.initial_sigma = read_initial_sigma(section.table("initial_sigma"), target);
  section.optional("initial_sigma");
  if (auto parameters = section.optional_table("parameters")) {
    target.parameters = read_parameters(*std::move(parameters), contract, target.estimator);
  }
  // One is let go with the errors of its glide, the other is told of no state that it makes anything of.
  if (target.estimator == "wind")
    section.refuse("initial_error", "has no effect on 'wind'", "[glide.initial_error]");
  if (!navigates)
    section.refuse("initial_error", fmt::format("has no effect on '{}'", target.estimator), "no such table");
  if (auto initial_error = section.optional_table("initial_error"))
    target.initial_error = read_initial_error(*initial_error);
  section.finish();
  return target;
}

}  // namespace

std::vector<TargetSetup> read_targets(Section& root, const Contract& contract) {
  std::vector<TargetSetup> targets;
  for (Section& section : root.table_or_tables("target")) {
    TargetSetup target = read_target(section, contract);
    if (std::ranges::find(targets, target.estimator, &TargetSetup::estimator) != targets.end()) {
      section.reject("estimator", fmt::format("'{}' is that of another [[target]] too", target.estimator),
                     "each estimator once");
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace canhil::scenario
