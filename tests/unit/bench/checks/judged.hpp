// Judges rules that do not come from a file.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "bench/bindings/canhil.hpp"
#include "bench/checks/judge.hpp"
#include "bench/checks/kinds/error.hpp"
#include "bench/checks/rule.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::checks {

template <class Kind>
scenario::Check check_of(Kind rule, const std::string& name = "it") {
  return {.name = name,
          .requirement = "R1",
          .kind = std::string(Kind::kind),
          .rule = std::make_shared<RuleOf<Kind>>(std::move(rule))};
}

/// The verdict on one rule.
template <class Kind>
CheckResult judged(const Kind& rule, const Observations& seen, const estimators::Truth& truth) {
  scenario::Scenario scenario;
  scenario.binding = bindings::canhil();
  scenario.checks.push_back(check_of(rule));
  return judge(scenario, {.seen = seen, .truth = truth, .estimators = estimators::all()}).checks.at(0);
}

/// A rule that limits the error of a quantity in a window of the run.
inline Error error_of(std::string estimator, const quantities::Quantity& quantity,
                      const scenario::Window& window, double below,
                      Error::Statistic statistic = Error::Statistic::max) {
  return {.judged = {.estimator = std::move(estimator), .quantity = &quantity},
          .statistic = statistic,
          .stretch = {.window = window},
          .below = below,
          .unit = quantity.unit};
}

/// The finding of a rule that uses only observations.
template <class Kind>
Finding found(const Kind& rule, const Observations& seen) {
  static const world::FlightRecord rest{{.start = {}, .motion = world::Rest{}}, 1'000'000, 10'000};
  Evidence evidence{.seen = seen, .truth = {.flight = rest}};
  return rule.judge(evidence);
}

}  // namespace canhil::checks
