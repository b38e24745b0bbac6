#include "bench/campaign_report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/campaign/seconds.hpp"
#include "bench/campaign_report/matrix.hpp"
#include "bench/checks/result_json.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::campaign {
namespace {

using nlohmann::ordered_json;

std::string_view label(const Answer& answer) {
  const auto outcome = answer.outcome();
  if (!outcome) return "-";
  return *outcome == checks::Outcome::pass ? "PASS" : *outcome == checks::Outcome::fail ? "FAIL" : "?";
}

std::string_view verdict(const Evaluation& evaluation) { return checks::name(evaluation.outcome()); }

ordered_json json_of(const Endings& endings) {
  ordered_json json{{"name", endings.variant},
                    {"runs", endings.runs},
                    {"completed", endings.completed},
                    {"ended_early", endings.runs - endings.completed - endings.wrong - endings.not_measured},
                    {"wrong_answers", endings.wrong},
                    {"not_measured", endings.not_measured},
                    {"not_finite", endings.not_finite}};
  if (!endings.first_fault.empty()) json["first_fault"] = endings.first_fault;
  return json;
}

ordered_json curve_of(const Answer& answer) {
  const quantities::Unit unit = answer.quantity->unit;
  ordered_json times = ordered_json::array(), values = ordered_json::array(), missing = ordered_json::array();
  for (const CurvePoint& point : answer.curve) {
    times.push_back(seconds(point.t_us));
    values.push_back(point.rms / unit.factor);
    missing.push_back(point.missing);
  }
  return {{"t_s", times}, {fmt::format("rms{}", unit.ending), values}, {"missing", missing}};
}

ordered_json json_of(const Answer& answer) {
  ordered_json json{{"metric", answer.metric}, {"kind", answer.kind}};
  if (answer.quantity != nullptr) json["quantity"] = answer.quantity->name;
  json["variant"] = answer.variant;
  json["measured"] = answer.measured;
  if (!answer.requirement.empty()) json["requirement"] = answer.requirement;
  if (const auto outcome = answer.outcome()) {
    json["expected"] = answer.expected;
    json["outcome"] = checks::name(*outcome);
  }
  // JSON has no infinity or NaN: the library writes null for them.
  for (const auto& [figure, value] : answer.figures) json[figure] = value.value_or(std::nan(""));
  checks::add_numbers(json, answer.judgement);
  if (!answer.curve.empty()) json["curve"] = curve_of(answer);
  return json;
}

std::string endings_text(const Endings& endings, std::size_t width) {
  std::string text = fmt::format("  {:<{}}  {} of {} runs completed", endings.variant, width,
                                 endings.completed, endings.runs);
  if (endings.wrong > 0) text += fmt::format(", {} with wrong answers", endings.wrong);
  if (endings.not_measured > 0) text += fmt::format(", {} not measured", endings.not_measured);
  if (endings.not_finite > 0) text += fmt::format(", {} with values that are not finite", endings.not_finite);
  if (!endings.first_fault.empty()) text += fmt::format("; {}", one_line(endings.first_fault));
  return text + "\n";
}

}  // namespace

std::string text(const Reported& all) {
  const auto& [campaign, evaluation, folder] = all;
  if (campaign.matrix && evaluation.answers.empty()) return matrix_text(campaign, evaluation, folder);
  std::string page;
  page += fmt::format(
      "{}\n  campaign {} · {} runs · seed {} · {}{}\n\n", one_line(campaign.title),
      one_line(campaign.sources.file), campaign.runs, campaign.seed,
      evaluation.identity.target.empty() ? "" : fmt::format("target {} · ", evaluation.identity.target),
      verdict(evaluation));
  std::size_t width = 7;
  for (const Variant& variant : campaign.variants) width = std::max(width, variant.name.size());
  for (const Endings& endings : evaluation.endings) page += endings_text(endings, width);

  std::string_view metric;
  for (const Answer& answer : evaluation.answers) {
    if (answer.metric != metric) page += fmt::format("\n  {}\n", answer.metric);
    metric = answer.metric;
    page +=
        fmt::format("    {:<4}  {:<{}}  {}", label(answer), answer.variant, width, one_line(answer.measured));
    if (answer.outcome()) page += fmt::format("  (expected {})", answer.expected);
    page += '\n';
  }
  if (campaign.matrix) page += "\n" + matrix_text(campaign, evaluation, folder);
  return page;
}

std::string json(const Reported& all) {
  const auto& [campaign, evaluation, folder] = all;
  ordered_json json{{"schema", "canhil-campaign-1"},
                    {"title", campaign.title},
                    {"campaign", campaign.sources.file},
                    {"campaign_hash", fmt::format("{:016x}", campaign.hash)},
                    {"runs", campaign.runs},
                    {"seed", campaign.matrix ? campaign.matrix->seed : campaign.seed},
                    {"outcome", verdict(evaluation)},
                    {"variants", ordered_json::array()},
                    {"answers", ordered_json::array()}};
  if (!evaluation.identity.target.empty()) json["target"] = evaluation.identity.target;
  json["provenance"] = {{"program", evaluation.identity.program},
                        {"dbc_hash", fmt::format("{:016x}", evaluation.identity.dbc_hash)},
                        {"unrounded", evaluation.identity.rounding == Rounding::none}};
  for (const Endings& endings : evaluation.endings) json["variants"].push_back(json_of(endings));
  for (const Answer& answer : evaluation.answers) json["answers"].push_back(json_of(answer));
  if (campaign.matrix) add_matrix(json, campaign, evaluation);
  // File names and the text of an ending may contain bytes that are not UTF-8; such bytes are replaced.
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace canhil::campaign
