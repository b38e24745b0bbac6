#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/campaign/seconds.hpp"
#include "bench/campaign_report/matrix.hpp"
#include "bench/campaign_report/report.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/plot.hpp"

namespace canhil::campaign {
namespace {

using report::escaped;

std::string endings_section(const Evaluation& evaluation) {
  report::Rows rows;
  for (const Endings& one : evaluation.endings)
    rows.push_back({escaped(one.variant), fmt::format("{} of {}", one.completed, one.runs),
                    one.first_fault.empty() ? "-" : escaped(one.first_fault)});
  return report::section("runs", "Runs",
                         report::table({"variant", "completed", "first run that was not"}, rows));
}

// The limit's margin, as the report of a run shows it.
std::string margin_of(const Answer& answer) {
  const auto margin = checks::margin(answer.judgement);
  return margin ? fmt::format("; margin {:.1f} %", 100 * *margin) : "";
}

// The metrics with curves, in the order of their pictures.
std::vector<std::string> metrics_with_curves(const Evaluation& evaluation) {
  std::vector<std::string> metrics;
  for (const Answer& answer : evaluation.answers) {
    if (!answer.curve.empty() && (metrics.empty() || metrics.back() != answer.metric))
      metrics.push_back(answer.metric);
  }
  return metrics;
}

// The id of the first picture of a metric: a number, because a name may contain any character.
std::string curve_id(const std::vector<std::string>& metrics, const std::string& metric) {
  return fmt::format("curve-{}", std::ranges::find(metrics, metric) - metrics.begin());
}

std::string answers_section(const Evaluation& evaluation) {
  const std::vector<std::string> drawn = metrics_with_curves(evaluation);
  std::vector<report::Judged> all;
  for (const Answer& answer : evaluation.answers) {
    const auto outcome = answer.outcome();
    all.push_back({.name = fmt::format("{}: {}", answer.metric, answer.variant),
                   .outcome = outcome ? std::string(checks::name(*outcome)) : "",
                   .measured = answer.measured + margin_of(answer),
                   .expected = answer.expected,
                   .requirement = answer.requirement,
                   .link = answer.curve.empty() ? "" : curve_id(drawn, answer.metric)});
  }
  return all.empty() ? "" : report::section("answers", "Answers", report::judgements(all));
}

// The curves of a metric: one picture for all variants with the same times.
std::vector<report::LinePlot> plots_of(const std::string& metric, const Evaluation& evaluation) {
  std::vector<report::LinePlot> plots;
  for (const Answer& answer : evaluation.answers) {
    if (answer.metric != metric || answer.curve.empty()) continue;
    const quantities::Unit& unit = answer.quantity->unit;
    std::vector<double> t_s, values;
    for (const CurvePoint& point : answer.curve) {
      t_s.push_back(seconds(point.t_us));
      values.push_back(point.rms / unit.factor);
    }
    if (plots.empty() || plots.back().t_s != t_s) {
      report::LinePlot& plot = plots.emplace_back();
      plot.title = fmt::format("{}, RMS over the runs", metric);
      plot.unit = std::string(unit.name);
      plot.t_s = std::move(t_s);
      plot.from_zero = true;
      plot.begins_at_first = true;
    }
    plots.back().lines.push_back({.name = answer.variant, .values = std::move(values)});
  }
  return plots;
}

std::string curves_section(const Evaluation& evaluation) {
  const std::vector<std::string> metrics = metrics_with_curves(evaluation);
  std::string figures;
  for (const std::string& metric : metrics) {
    std::string id = curve_id(metrics, metric);
    for (const report::LinePlot& plot : plots_of(metric, evaluation))
      figures += report::figure(plot.title, report::drawn(plot), "", std::exchange(id, ""));
  }
  return figures.empty() ? "" : report::section("curves", "Curves", report::grid(figures));
}

std::string provenance_of(const Campaign& campaign, const Identity& identity) {
  const report::Json facts{
      {"campaign", campaign.sources.file},
      {"hash of the campaign", fmt::format("{:016x}", identity.campaign_hash)},
      {"hash of the DBC", fmt::format("{:016x}", identity.dbc_hash)},
      {"program", identity.program},
      {"target", identity.target.empty() ? "the target's own code, in process" : identity.target}};
  return report::section("provenance", "Provenance", report::facts(facts));
}

}  // namespace

std::string page(const Reported& all) {
  const auto& [campaign, evaluation, folder] = all;
  const std::string_view verdict = checks::name(evaluation.outcome());
  std::string body = report::head(campaign.title, fmt::format("{}: {} runs of each of {} variants",
                                                              escaped(campaign.sources.file), campaign.runs,
                                                              campaign.variants.size())) +
                     report::verdict(verdict, evaluation.not_judged());
  if (!campaign.matrix || !evaluation.answers.empty())
    body += endings_section(evaluation) + answers_section(evaluation) + curves_section(evaluation);
  if (campaign.matrix) body += matrix_html(campaign, evaluation, folder);
  body += provenance_of(campaign, evaluation.identity);
  return report::whole_page(escaped(fmt::format("{}: {}", verdict, campaign.title)), report::styles, body,
                            report::scripts);
}

}  // namespace canhil::campaign
