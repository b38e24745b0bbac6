// Checks how many answers in a window carry a mark (an outcome or flag), and when the first answer with the
// mark came.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct Answers {
  static constexpr std::string_view kind = "answers";
  static constexpr std::string_view meaning =
      "Passes when the number and the times of the answers that have a mark meet the limits. At least one "
      "limit is needed. In the name of a key, MARK stands for a mark of the estimator (scenarios.md).";
  struct Count {
    std::string mark;  ///< one of the estimator's marks
    std::optional<std::int64_t> at_least{}, at_most{};
    std::optional<std::int64_t> before_us{};  ///< the first answer with the mark must come before this time
  };
  std::string estimator;
  scenario::Window window;
  std::vector<Count> counts;
  bool one_of_several{};  ///< more than one estimator runs

  static Answers read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] std::vector<std::string> needs_answers_of() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
