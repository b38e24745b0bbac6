#include "bench/commands/conformance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/report/run_reports.hpp"

namespace canhil::conformance {

using checks::CheckResult;
using checks::Outcome;

std::string text(const Report& report) {
  std::string out =
      fmt::format("Conformance: {}\n  as {}, {}\n\n", report.target, report.estimator, report.algorithm);
  for (const CheckResult& rule : report.rules) {
    const bool kept = rule.outcome == Outcome::pass;
    out += fmt::format("  {}  {:<13}  {}\n", kept ? "PASS" : "FAIL", rule.name, rule.expected);
    if (!kept) out += fmt::format("      - {}\n", rule.measured);
  }
  const auto kept = std::ranges::count(report.rules, Outcome::pass, &CheckResult::outcome);
  return out + fmt::format("\n{}: {} of {} rules kept ({:.1f} s)\n", checks::name(report.outcome()), kept,
                           report.rules.size(), report.wall_s);
}

std::string json(const Report& report) {
  auto rules = nlohmann::ordered_json::array();
  for (const CheckResult& rule : report.rules) {
    rules.push_back({{"id", rule.name}, {"text", rule.expected}, {"outcome", checks::name(rule.outcome)}});
    if (rule.outcome != Outcome::pass) rules.back()["wrong"] = rule.measured;
  }
  const nlohmann::ordered_json all{{"schema", "canhil-conformance-1"},
                                   {"target", report.target},
                                   {"estimator", report.estimator},
                                   {"algorithm", report.algorithm},
                                   {"started_s", report.started_s},
                                   {"wall_s", report.wall_s},
                                   {"outcome", checks::name(report.outcome())},
                                   {"rules", std::move(rules)}};
  // The command of the target may contain bytes that are not valid UTF-8; dump() replaces them.
  return all.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string junit(const Report& report) {
  return report::junit_whole(
      report::junit_suite("conformance", "conformance", report.rules, report.wall_s, report.started_s));
}

}  // namespace canhil::conformance
