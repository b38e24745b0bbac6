// Checks that the mean of a NEES or NIS over a window lies in the range of a consistent filter.
#pragma once

#include <variant>

#include "bench/checks/rule.hpp"
#include "bench/quantities/quantity.hpp"

namespace canhil::checks {

/// The mean lies between two values.
struct MeanBetween {
  double low = 0;
  double high = 0;
};
/// The mean must lie in the central chi-square interval that has this probability. This bound is permitted
/// only for white statistics (NIS).
struct Probability {
  double value = 0;
};

struct Consistency {
  static constexpr std::string_view kind = "consistency";
  static constexpr std::string_view meaning =
      "Passes when the mean of a NEES or NIS over the window lies between the bounds.";
  Subject judged;
  scenario::Window window;
  std::variant<MeanBetween, Probability> bound;
  std::shared_ptr<const Condition> condition{};

  static Consistency read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return judged.text; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
