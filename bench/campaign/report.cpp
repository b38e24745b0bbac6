#include "bench/campaign/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "dbc/text/escape.hpp"

namespace canhil::campaign {
namespace {

using nlohmann::ordered_json;

std::string_view label(const Answer& answer) {
  if (!answer.passed) return "-";
  return *answer.passed ? "PASS" : "FAIL";
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

ordered_json json_of(const Answer& answer) {
  ordered_json json{{"metric", answer.metric},
                    {"kind", answer.kind},
                    {"quantity", answer.quantity->name},
                    {"variant", answer.variant},
                    {"measured", answer.measured}};
  if (!answer.requirement.empty()) json["requirement"] = answer.requirement;
  if (answer.passed) {
    json["expected"] = answer.expected;
    json["outcome"] = *answer.passed ? "pass" : "fail";
  }
  // JSON has no infinity or NaN: the library writes null for them.
  for (const auto& [figure, value] : answer.figures) json[figure] = value.value_or(std::nan(""));
  if (answer.curve.empty()) return json;
  const quantities::Unit unit = answer.quantity->unit;
  ordered_json times = ordered_json::array(), values = ordered_json::array(), missing = ordered_json::array();
  for (const CurvePoint& point : answer.curve) {
    times.push_back(static_cast<double>(point.t_us) / 1e6);
    values.push_back(point.rms / unit.factor);
    missing.push_back(point.missing);
  }
  json["curve"] = {{"t_s", times}, {fmt::format("rms{}", unit.ending), values}, {"missing", missing}};
  return json;
}

}  // namespace

std::string text(const Campaign& campaign, const Evaluation& evaluation) {
  std::string page;
  page += fmt::format("{}\n  campaign {} · {} runs · seed {} · {}{}\n\n", one_line(campaign.title),
                      one_line(campaign.sources.file), campaign.runs, campaign.seed,
                      evaluation.target.empty() ? "" : fmt::format("target {} · ", evaluation.target),
                      verdict(evaluation));

  std::size_t width = 7;
  for (const Variant& variant : campaign.variants) width = std::max(width, variant.name.size());
  for (const Endings& endings : evaluation.endings) {
    page += fmt::format("  {:<{}}  {} of {} runs completed", endings.variant, width, endings.completed,
                        endings.runs);
    if (endings.wrong > 0) page += fmt::format(", {} with wrong answers", endings.wrong);
    if (endings.not_measured > 0) page += fmt::format(", {} not measured", endings.not_measured);
    if (endings.not_finite > 0)
      page += fmt::format(", {} with values that are not finite", endings.not_finite);
    if (!endings.first_fault.empty()) page += fmt::format("; {}", one_line(endings.first_fault));
    page += '\n';
  }

  std::string_view metric;
  for (const Answer& answer : evaluation.answers) {
    if (answer.metric != metric) page += fmt::format("\n  {}\n", answer.metric);
    metric = answer.metric;
    page += fmt::format("    {:<4}  {:<{}}  {}", label(answer), answer.variant, width, answer.measured);
    if (answer.passed) page += fmt::format("  (expected {})", answer.expected);
    page += '\n';
  }
  return page;
}

std::string json(const Campaign& campaign, const Evaluation& evaluation) {
  ordered_json json{{"title", campaign.title},
                    {"campaign", campaign.sources.file},
                    {"campaign_hash", fmt::format("{:016x}", campaign.hash)},
                    {"runs", campaign.runs},
                    {"seed", campaign.seed},
                    {"outcome", verdict(evaluation)},
                    {"variants", ordered_json::array()},
                    {"answers", ordered_json::array()}};
  if (!evaluation.target.empty()) json["target"] = evaluation.target;
  for (const Endings& endings : evaluation.endings) json["variants"].push_back(json_of(endings));
  for (const Answer& answer : evaluation.answers) json["answers"].push_back(json_of(answer));
  // File names and the text of an ending may contain bytes that are not UTF-8; such bytes are replaced.
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace canhil::campaign
