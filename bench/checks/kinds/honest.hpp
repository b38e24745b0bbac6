// Checks every answer that has neither the mark `degraded` nor the mark `blind`: the error of the answer must
// be at most a given multiple of its sigma.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct Honest {
  static constexpr std::string_view kind = "honest";
  static constexpr std::string_view meaning =
      "Passes when no trusted answer has an error of more than `over_sigma` times the sigma that the answer "
      "reports (honesty.md).";
  std::vector<const estimators::Estimator*> estimators;
  std::string named;      ///< the estimator that the check names; empty: all estimators that run
  double over_sigma = 5;  ///< upper limit of the quantity trusted.over_sigma

  static Honest read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return named; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const;
  [[nodiscard]] std::vector<std::string> needs_answers_of() const { return held_against_truth(); }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
