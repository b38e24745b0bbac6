// Checks that the reported sigma grows while the target lacks information: during a fault, or in a window.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"

namespace canhil::checks {

struct SigmaGrows {
  static constexpr std::string_view kind = "sigma_grows";
  static constexpr std::string_view meaning =
      "Passes when the sigma of the quantity grows in the window. Use it for a window in which measurements "
      "are missing.";
  Subject judged;
  std::string fault;  ///< empty: the check gives the window
  scenario::Window window;
  double by = 1;  ///< the sigma must grow by more than this factor

  static SigmaGrows read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return judged.text; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  [[nodiscard]] std::vector<std::string> held_against_truth() const { return {}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
