#include "bench/papers/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::papers {

Row verdict(std::string claim, std::string paper, std::string ours, Mark mark, std::string words) {
  return {.cells = {std::move(claim), std::move(paper), std::move(ours)},
          .mark = mark,
          .verdict = std::move(words)};
}

Row reproduces(std::string claim, std::string paper, std::string ours, bool yes) {
  return verdict(std::move(claim), std::move(paper), std::move(ours), yes ? Mark::yes : Mark::no,
                 yes ? "reproduces" : "does not reproduce");
}

Row bar(std::string name, std::string asked, std::string measured, bool pass) {
  return verdict(std::move(name), std::move(asked), std::move(measured), pass ? Mark::yes : Mark::no,
                 pass ? "pass" : "FAIL");
}

void add_bars(Table& table, const Flown& flown, std::string_view requirement) {
  const auto answers = flown.answers(requirement);
  for (const campaign::Answer* answer : answers) {
    // A metric may be asked of several variants: then the rows tell which.
    const bool several = std::ranges::count(answers, answer->metric, &campaign::Answer::metric) > 1;
    table.rows.push_back(bar(fmt::format("{}: {}{}", requirement, answer->metric,
                                         several ? fmt::format(" ({})", answer->variant) : ""),
                             answer->expected, answer->measured, answer->passed.value_or(false)));
  }
}

bool passed(const Flown& flown, std::string_view requirement) {
  const auto answers = flown.answers(requirement);
  return !answers.empty() &&
         std::ranges::all_of(answers, [](const auto* answer) { return answer->passed.value_or(false); });
}

}  // namespace canhil::papers
