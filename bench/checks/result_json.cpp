#include "bench/checks/result_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/checks/condition.hpp"

namespace canhil::checks {
namespace {

using Json = nlohmann::ordered_json;

double in_seconds(std::int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

void add_number(Json& json, std::string_view key, const std::optional<double>& value) {
  if (value && std::isfinite(*value)) json[std::string(key)] = *value;
}

void add_limit(Json& json, const std::string& key, const std::optional<Limit>& limit) {
  if (!limit) return;
  json[key] = limit->value;
  json[key + "_inclusive"] = limit->inclusive;
}

std::optional<double> number_in(const Json& json, std::string_view key) {
  const auto found = json.find(key);
  return found == json.end() ? std::nullopt : std::optional(found->get<double>());
}

std::optional<std::int64_t> time_in(const Json& json, std::string_view key) {
  const auto t_s = number_in(json, key);
  return t_s ? std::optional<std::int64_t>(std::llround(*t_s * 1e6)) : std::nullopt;
}

std::optional<Limit> limit_in(const Json& json, const std::string& key) {
  const auto value = number_in(json, key);
  if (!value) return std::nullopt;
  return Limit{.value = *value, .inclusive = json.value(key + "_inclusive", true)};
}

}  // namespace

void add_numbers(Json& json, const Judgement& judgement) {
  const auto& [criterion, measurement] = judgement;
  if (!criterion.quantity.empty()) json["quantity"] = criterion.quantity;
  if (!criterion.estimator.empty()) json["estimator"] = criterion.estimator;
  if (!criterion.statistic.empty()) json["statistic"] = criterion.statistic;
  add_number(json, "value", measurement.value);
  add_limit(json, "lower", criterion.lower);
  add_limit(json, "upper", criterion.upper);
  if (criterion.lower || criterion.upper) json["unit"] = criterion.unit;
  add_number(json, "margin", margin(judgement));
  if (measurement.count) json["count"] = *measurement.count;
  if (criterion.stretch && criterion.stretch->to_go_s) {
    json["time_to_go_s"] = {criterion.stretch->to_go_s->first, criterion.stretch->to_go_s->second};
  } else if (criterion.stretch) {
    json["from_s"] = in_seconds(criterion.stretch->window.from_us);
    json["to_s"] = in_seconds(criterion.stretch->window.to_us);
  }
  if (criterion.stretch && criterion.stretch->condition != nullptr)
    json["while"] = criterion.stretch->condition->text();
  if (measurement.worst_at_us) json["worst_at_s"] = in_seconds(*measurement.worst_at_us);
}

Json json_of(const CheckResult& check) {
  Json json{{"name", check.name},
            {"kind", check.kind},
            {"requirement", check.requirement},
            {"outcome", name(check.outcome)},
            {"measured", check.measured},
            {"expected", check.expected}};
  add_numbers(json, check.judgement);
  return json;
}

CheckResult result_in(const Json& check) {
  const auto outcome = outcome_named(check.at("outcome").get<std::string>());
  if (!outcome) throw Json::other_error::create(501, "unknown outcome", &check);
  return {.name = check.at("name"),
          .kind = check.at("kind"),
          .requirement = check.value("requirement", ""),
          .outcome = *outcome,
          .measured = check.at("measured"),
          .expected = check.at("expected"),
          .judgement = judgement_of(check)};
}

std::optional<Outcome> outcome_named(std::string_view name) {
  using enum Outcome;
  for (const Outcome one : {pass, fail, not_measured}) {
    if (checks::name(one) == name) return one;
  }
  return std::nullopt;
}

Judgement judgement_of(const Json& check) {
  return {.criterion = {.quantity = check.value("quantity", ""),
                        .estimator = check.value("estimator", ""),
                        .statistic = check.value("statistic", ""),
                        .lower = limit_in(check, "lower"),
                        .upper = limit_in(check, "upper"),
                        .unit = check.value("unit", "")},
          .measurement = {.value = number_in(check, "value"), .worst_at_us = time_in(check, "worst_at_s")}};
}

}  // namespace canhil::checks
