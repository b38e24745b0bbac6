// Checks that the reported sigma of a quantity lies in a range. A filter's covariance hardly depends on the
// noise of one run, so a single run suffices for this check. In contrast, a mean of squared errors needs many
// runs.
#pragma once

#include "bench/checks/rule.hpp"
#include "bench/quantities/quantity.hpp"

namespace canhil::checks {

struct Sigma {
  static constexpr std::string_view kind = "sigma";
  static constexpr std::string_view meaning =
      "Passes when every answer in the window has a sigma of the quantity, and every such sigma lies between "
      "the bounds.";
  Subject judged;
  Stretch stretch;
  double low = 0, high = 0;  ///< [SI]
  quantities::Unit unit{};

  static Sigma read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return judged.text; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const { return {}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
