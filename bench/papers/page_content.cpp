#include "bench/papers/page_content.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::papers {
namespace {

// One row for each answer. If a metric applies to several variants, the rows name the variant.
std::string bar_rows(const Flown& flown, std::string_view requirement) {
  const auto answers = flown.answers(requirement);
  std::string rows;
  for (const campaign::Answer* answer : answers) {
    const bool several = std::ranges::count(answers, answer->metric, &campaign::Answer::metric) > 1;
    rows +=
        fmt::format("{}| {}: {}{} | {} | {} | {} |", rows.empty() ? "" : "\n", requirement, answer->metric,
                    several ? fmt::format(" ({})", answer->variant) : "", answer->expected, answer->measured,
                    answer->passed.value_or(false) ? "[yes] pass" : "[no] FAIL");
  }
  return rows;
}

}  // namespace

void add_shared_names(Names& names, const Results& results, std::uint64_t runs, std::uint64_t enough) {
  const bool unrounded = results.campaigns.front().campaign.rounding == Rounding::none;
  names["runs"] = [=](Words&) { return fmt::to_string(runs); };
  names["enough"] = [=](Words&) { return fmt::to_string(enough); };
  names["too_few_runs"] = [=](Words&) { return runs < enough; };
  names["unrounded"] = [=](Words&) { return unrounded; };
  names["frames"] = [=](Words&) {
    return unrounded ? "frames without the bus's rounding (--unrounded)" : "frames quantised as on the bus";
  };
  names["flights"] = [&results](Words&) {
    std::size_t sum = 0;
    for (const Flown& one : results.campaigns) sum += one.campaign.variants.size() * one.campaign.runs;
    return fmt::to_string(sum);
  };
  names["bars"] = [&results](Words& words) {
    const Flown& flown = results.of(words.next());
    return bar_rows(flown, words.rest());
  };
  const auto verdict = [&names](const char* yes, const char* no) {
    return [&names, yes, no](Words& words) {
      const auto holds = names.find(words.next());
      if (holds == names.end()) throw std::logic_error("is unknown");
      return std::get<bool>(holds->second(words)) ? yes : no;
    };
  };
  names["reproduces"] = verdict("[yes] reproduces", "[no] does not reproduce");
  names["pass"] = verdict("[yes] pass", "[no] FAIL");
}

}  // namespace canhil::papers
