#include <fmt/format.h>

#include "bench/campaign_report/matrix.hpp"
#include "bench/campaign_report/report.hpp"
#include "bench/report/page_parts.hpp"
#include "bench/report/plot.hpp"

namespace canhil::campaign {
namespace {

using report::escaped;

std::string sign_of(std::string_view outcome) {
  const auto [style, sign] = report::look_of(outcome);
  return fmt::format("<span class=\"{}\">{} {}</span>", style, sign, outcome);
}

std::string endings_section(const Evaluation& evaluation) {
  report::Rows rows;
  for (const Endings& one : evaluation.endings)
    rows.push_back({escaped(one.variant), fmt::format("{} of {}", one.completed, one.runs),
                    one.first_fault.empty() ? "-" : escaped(one.first_fault)});
  return "<section><h2>Runs</h2>\n" +
         report::table({"variant", "completed", "first run that was not"}, rows) + "</section>\n";
}

std::string margin_of(const Answer& answer) {
  const auto margin = checks::margin(answer.judgement);
  return margin ? fmt::format("{:.1f} %", 100 * *margin) : "-";
}

std::string answers_section(const Evaluation& evaluation) {
  report::Rows rows;
  for (const Answer& answer : evaluation.answers) {
    const auto outcome = answer.outcome();
    rows.push_back({escaped(answer.metric), escaped(answer.variant),
                    outcome ? sign_of(checks::name(*outcome)) : std::string("-"), escaped(answer.measured),
                    escaped(answer.expected), margin_of(answer), escaped(answer.requirement)});
  }
  if (rows.empty()) return "";
  return "<section><h2>Answers</h2>\n" +
         report::table(
             {"metric or check", "variant", "outcome", "measured", "expected", "margin", "requirement"},
             rows) +
         "</section>\n";
}

std::string curves_section(const Evaluation& evaluation) {
  std::string figures;
  for (const Answer& answer : evaluation.answers) {
    if (answer.curve.empty()) continue;
    const quantities::Unit& unit = answer.quantity->unit;
    report::LinePlot plot{.title = fmt::format("{}, {}", answer.metric, answer.variant),
                          .unit = std::string(unit.name),
                          .t_s = {},
                          .low = {},
                          .high = {}};
    plot.from_zero = true;
    for (const CurvePoint& point : answer.curve) {
      plot.t_s.push_back(static_cast<double>(point.t_us) / 1e6);
      plot.low.push_back(point.rms / unit.factor);
      plot.high.push_back(point.rms / unit.factor);
    }
    figures += report::figure(plot.title, report::svg(plot), "RMS over the runs, by time in s.");
  }
  return figures.empty() ? "" : "<section><h2>Curves</h2>\n" + figures + "</section>\n";
}

std::string provenance_of(const Campaign& campaign, const Identity& identity) {
  const report::Rows rows{
      {"campaign", escaped(campaign.sources.file)},
      {"hash of the campaign", fmt::format("{:016x}", identity.campaign_hash)},
      {"hash of the DBC", fmt::format("{:016x}", identity.dbc_hash)},
      {"program", escaped(identity.program)},
      {"target", identity.target.empty() ? "the target's own code, in process" : escaped(identity.target)}};
  return "<section><h2>Provenance</h2>\n" + report::table({"what", "value"}, rows) + "</section>\n";
}

}  // namespace

std::string page(const Reported& all) {
  const auto& [campaign, evaluation, folder] = all;
  const std::string_view verdict = checks::name(evaluation.outcome());
  const auto [style, sign] = report::look_of(verdict);
  std::string body = fmt::format("<h1>{}</h1>\n<p class=\"sub\">{} runs of each variant</p>\n",
                                 escaped(campaign.title), campaign.runs);
  body += fmt::format("<p class=\"verdict {}\"><b>{} {}</b> {}</p>\n", style, sign, verdict,
                      escaped(evaluation.not_judged()));
  if (!campaign.matrix || !evaluation.answers.empty())
    body += endings_section(evaluation) + answers_section(evaluation) + curves_section(evaluation);
  if (campaign.matrix) body += matrix_html(campaign, evaluation, folder);
  body += provenance_of(campaign, evaluation.identity);
  return report::whole_page(fmt::format("{}: {}", verdict, escaped(campaign.title)), report::styles, body);
}

}  // namespace canhil::campaign
