// No answer is sure and wrong: one that says neither degraded nor blind has no error far beyond its sigma.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct Honest {
  static constexpr std::string_view kind = "honest";
  static constexpr std::string_view meaning = "Passes when no answer is sure and wrong (honesty.md).";
  std::vector<const estimators::Estimator*> estimators;
  std::string named;      ///< the estimator that the check names; empty: all that run
  double over_sigma = 5;  ///< the quantity trusted.over_sigma is to stay at or below it

  static Honest read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return named; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
