#include <fmt/format.h>

#include "bench/campaign_report/report.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::campaign {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }
std::string number(const std::optional<checks::Limit>& limit) {
  return limit ? fmt::format("{}", limit->value) : "";
}

}  // namespace

std::string csv(const Reported& all) {
  std::string lines =
      "metric,kind,requirement,variant,outcome,value,lower,upper,unit,margin,measured,expected\n";
  for (const Answer& answer : all.evaluation.answers) {
    const auto& [criterion, measurement] = answer.judgement;
    const auto outcome = answer.outcome();
    lines += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{}\n", for_csv(answer.metric), answer.kind,
        for_csv(answer.requirement), for_csv(answer.variant), outcome ? checks::name(*outcome) : "",
        number(measurement.value), number(criterion.lower), number(criterion.upper), criterion.unit,
        number(checks::margin(answer.judgement)), for_csv(answer.measured), for_csv(answer.expected));
  }
  return lines;
}

}  // namespace canhil::campaign
