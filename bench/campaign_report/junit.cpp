#include <fmt/format.h>

#include <vector>

#include "bench/campaign_report/report.hpp"
#include "bench/report/run_reports.hpp"

namespace canhil::campaign {
namespace {

checks::Outcome outcome_of(const matrix::Response& response) {
  using Kind = matrix::Response::Kind;
  return response.kind == Kind::violated       ? checks::Outcome::fail
         : response.kind == Kind::not_measured ? checks::Outcome::not_measured
                                               : checks::Outcome::pass;
}

}  // namespace

std::string junit(const Reported& all) {
  const auto& [campaign, evaluation, folder] = all;
  std::string suites;
  for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
    const std::string& name = campaign.variants[variant].name;
    std::vector<checks::CheckResult> cases;
    for (const Answer& answer : evaluation.answers) {
      const auto outcome = answer.outcome();
      if (answer.variant != name || !outcome) continue;
      cases.push_back({.name = answer.metric,
                       .kind = answer.kind,
                       .requirement = answer.requirement,
                       .outcome = *outcome,
                       .measured = answer.measured,
                       .expected = answer.expected,
                       .judgement = answer.judgement});
    }
    for (const Responded& flight : evaluation.responses) {
      if (flight.key.variant != variant) continue;
      cases.push_back(
          {.name = campaign.runs > 1 ? fmt::format("response, run {}", flight.key.run) : "response",
           .kind = "response",
           .requirement = "",
           .outcome = outcome_of(flight.run.response),
           .measured = to_text(flight.run.response),
           .expected = "no violation"});
    }
    // A variant with nothing to judge has no suite.
    if (!cases.empty())
      suites += report::junit_suite(name, fmt::format("{}.{}", campaign.sources.file, name), cases, 0, 0);
  }
  return report::junit_whole(suites);
}

}  // namespace canhil::campaign
