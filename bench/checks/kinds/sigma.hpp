// The sigma that a target tells beside a quantity lies where it should. A filter's covariance hardly depends
// on the noise that it saw, so one run tells what the mean of its squared errors tells only over many.
#pragma once

#include "bench/checks/rule.hpp"
#include "bench/quantities/quantity.hpp"

namespace canhil::checks {

struct Sigma {
  static constexpr std::string_view kind = "sigma";
  static constexpr std::string_view meaning =
      "Passes when every answer of the window has a sigma of the quantity, and it lies between the bounds.";
  Subject of;
  Stretch stretch;
  double low = 0, high = 0;  ///< [SI]
  quantities::Unit unit{};

  static Sigma read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return of.words; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {of}; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const { return {}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
