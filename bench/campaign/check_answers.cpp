#include "bench/campaign/check_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "bench/campaign/seconds.hpp"
#include "bench/checks/probability.hpp"

namespace canhil::campaign {
namespace {

using checks::CheckResult;
using checks::Outcome;

// A check in one run; null: the run has no such result.
struct InRun {
  const RunSeries* run = nullptr;
  const CheckResult* result = nullptr;
  Outcome outcome = Outcome::pass;
};

// A check of every run is told only where it does not pass.
Outcome outcome_in(const RunSeries& run, const CheckResult* result) {
  using Kind = drive::Ending::Kind;
  if (run.ending.kind == Kind::completed || run.ending.kind == Kind::wrong_answers ||
      run.ending.kind == Kind::wrong_end || run.ending.kind == Kind::not_measured)
    return result == nullptr ? Outcome::pass : result->outcome;
  return run.ending.kind == Kind::plant_failed ? Outcome::not_measured : Outcome::fail;
}

// How near a result is to its limit: negative beyond it.
double distance_of(const CheckResult& result) {
  const auto margin = checks::margin(result.judgement);
  return margin.value_or(-result.judgement.measurement.value.value_or(0));
}

std::string value_text(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::size_t count(const std::vector<InRun>& all, Outcome outcome) {
  return static_cast<std::size_t>(std::ranges::count(all, outcome, &InRun::outcome));
}

// The worst of the values, and their median.
void add_values(const std::vector<InRun>& all, Answer& out) {
  const InRun* worst = nullptr;
  std::vector<double> values;
  for (const InRun& one : all) {
    if (one.result == nullptr || !one.result->judgement.measurement.value) continue;
    values.push_back(*one.result->judgement.measurement.value);
    if (worst == nullptr || distance_of(*one.result) < distance_of(*worst->result)) worst = &one;
  }
  if (worst == nullptr) return;
  out.judgement = worst->result->judgement;
  const std::string& unit = out.judgement.criterion.unit;
  const double value = *out.judgement.measurement.value, median = checks::median(values);
  out.measured += fmt::format("; worst {} in run {}", value_text(value, unit), worst->run->run);
  if (const auto at_us = out.judgement.measurement.worst_at_us)
    out.measured += fmt::format(" at {:g} s", seconds(*at_us));
  out.measured += fmt::format(", median {}", value_text(median, unit));
  out.figures.emplace_back("worst_run", static_cast<double>(worst->run->run));
  out.figures.emplace_back("median", median);
}

// The first run that does not pass, and why.
void add_reason(const std::vector<InRun>& all, Outcome outcome, Answer& out) {
  const auto first = std::ranges::find(all, outcome, &InRun::outcome);
  if (first == all.end()) return;
  const bool ended = first->run->ending.kind != drive::Ending::Kind::completed || first->result == nullptr;
  out.measured += fmt::format("; run {}: {}", first->run->run,
                              ended ? first->run->ending.detail : first->result->measured);
}

Answer answer_of(const std::string& variant, const CheckResult& check, double share,
                 const std::vector<InRun>& all) {
  Answer out{.metric = check.name, .kind = check.kind, .requirement = check.requirement, .variant = variant};
  const std::size_t failed = count(all, Outcome::fail), unjudged = count(all, Outcome::not_measured),
                    passed = all.size() - failed - unjudged;
  constexpr double rounding = 1e-9;
  const auto may_fail = static_cast<std::size_t>((1 - share) * static_cast<double>(all.size()) + rounding);
  out.expected = check.expected + (share < 1 ? fmt::format("; in at least {:g} % of the runs", 100 * share)
                                             : std::string("; in all runs"));
  if (failed > may_fail)
    out.passed = false;
  else if (failed + unjudged <= may_fail)
    out.passed = true;
  out.measured = fmt::format("{} of {} runs pass", passed, all.size());
  if (unjudged > 0) out.measured += fmt::format(", {} not measured", unjudged);
  out.figures = {{"passed", static_cast<double>(passed)},
                 {"failed", static_cast<double>(failed)},
                 {"not_measured", static_cast<double>(unjudged)}};
  add_values(all, out);
  add_reason(all, failed > 0 ? Outcome::fail : Outcome::not_measured, out);
  return out;
}

// One result of each check that the runs have, those of the scenario first.
std::vector<CheckResult> checks_in(const scenario::Scenario& scenario, const std::vector<Judged>& judged) {
  std::vector<CheckResult> all;
  for (const scenario::Check& check : scenario.checks)
    all.push_back({.name = check.name,
                   .kind = check.kind,
                   .requirement = check.requirement,
                   .measured = {},
                   .expected = {}});
  for (const Judged& one : judged) {
    for (const CheckResult& check : one.checks) {
      const auto known = std::ranges::find(all, check.name, &CheckResult::name);
      if (known == all.end())
        all.push_back(check);
      else if (known->expected.empty())
        *known = check;
    }
  }
  return all;
}

}  // namespace

std::vector<Answer> answers_of_checks(const Campaign& campaign, std::size_t variant, const Runs& runs,
                                      const std::vector<Judged>& judged) {
  std::vector<Answer> answers;
  const Variant& of = campaign.variants[variant];
  for (const CheckResult& check : checks_in(of.scenario, judged)) {
    std::vector<InRun> all;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto found = std::ranges::find(judged[i].checks, check.name, &CheckResult::name);
      const CheckResult* result = found == judged[i].checks.end() ? nullptr : &*found;
      all.push_back({.run = &runs[i], .result = result, .outcome = outcome_in(runs[i], result)});
    }
    const auto shared = std::ranges::find(*campaign.checks, check.name, &RunCheck::name);
    answers.push_back(
        answer_of(of.name, check, shared == campaign.checks->end() ? 1 : shared->share_at_least, all));
  }
  return answers;
}

}  // namespace canhil::campaign
