#include "bench/checks/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/checks/finding.hpp"

namespace canhil::checks {
namespace {

// The names of the checks with this outcome.
std::string names(const Verdict& verdict, Outcome outcome) {
  constexpr int shown = 3;
  int found = 0;
  std::string list;
  for (const CheckResult& check : verdict.checks) {
    if (check.outcome != outcome || ++found > shown) continue;
    list += (list.empty() ? "" : ", ") + check.name;
  }
  return found > shown ? list + ", ..." : list;
}

}  // namespace

CheckResult result_of(std::string name, std::string_view kind, std::string requirement, Finding finding) {
  return {
      .name = std::move(name),
      .kind = std::string(kind),
      .requirement = std::move(requirement),
      .outcome = finding.outcome,
      .measured = std::move(finding.measured),
      .expected = std::move(finding.expected.text),
      .judgement = {.criterion = std::move(finding.expected.criterion), .measurement = finding.measurement}};
}

void conclude(Verdict& verdict, const std::string& ended_early) {
  const auto count = [&](Outcome outcome) {
    return std::ranges::count(verdict.checks, outcome, &CheckResult::outcome);
  };
  const std::string_view checks = verdict.checks.size() == 1 ? "check" : "checks";
  if (!ended_early.empty()) {
    verdict.outcome = Outcome::fail;
    verdict.reason = ended_early;
  } else if (count(Outcome::fail) > 0) {
    verdict.outcome = Outcome::fail;
    verdict.reason = fmt::format("{} of {} {} failed: {}", count(Outcome::fail), verdict.checks.size(),
                                 checks, names(verdict, Outcome::fail));
  } else if (count(Outcome::not_measured) > 0) {
    verdict.outcome = Outcome::not_measured;
    verdict.reason = fmt::format("{} of {} {} could not be measured: {}", count(Outcome::not_measured),
                                 verdict.checks.size(), checks, names(verdict, Outcome::not_measured));
  } else {
    verdict.outcome = Outcome::pass;
    verdict.reason = fmt::format("{} {} passed", verdict.checks.size(), checks);
  }
}

}  // namespace canhil::checks
