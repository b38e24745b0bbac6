#include "bench/commands/conformance_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/report/run_reports.hpp"

namespace canhil::conformance {

std::string text(const Report& report) {
  std::string out =
      fmt::format("Conformance: {}\n  as {}, {}\n\n", report.target, report.estimator, report.algorithm);
  for (const Finding& finding : report.findings) {
    out += fmt::format("  {}  {:<13}  {}\n", finding.wrong.empty() ? "PASS" : "FAIL", finding.rule.id,
                       finding.rule.text);
    if (!finding.wrong.empty()) out += fmt::format("      - {}\n", finding.wrong);
  }
  const auto kept = std::ranges::count_if(report.findings, [](const auto& one) { return one.wrong.empty(); });
  return out + fmt::format("\n{}: {} of {} rules kept ({:.1f} s)\n", checks::name(report.outcome()), kept,
                           report.findings.size(), report.wall_s);
}

std::string json(const Report& report) {
  auto rules = nlohmann::ordered_json::array();
  for (const Finding& finding : report.findings) {
    rules.push_back({{"id", finding.rule.id},
                     {"text", finding.rule.text},
                     {"outcome", finding.wrong.empty() ? "pass" : "fail"}});
    if (!finding.wrong.empty()) rules.back()["wrong"] = finding.wrong;
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
  std::vector<checks::CheckResult> cases;
  for (const Finding& finding : report.findings) {
    const bool kept = finding.wrong.empty();
    cases.push_back({.name = finding.rule.id,
                     .kind = finding.rule.family,
                     .requirement = finding.rule.id,
                     .outcome = kept ? checks::Outcome::pass : checks::Outcome::fail,
                     .measured = kept ? "so" : finding.wrong,
                     .expected = finding.rule.text});
  }
  return report::junit_whole(
      report::junit_suite("conformance", "conformance", cases, report.wall_s, report.started_s));
}

}  // namespace canhil::conformance
