#include "bench/campaign/metric.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/campaign/metric_rule.hpp"
#include "bench/campaign/seconds.hpp"
#include "bench/campaign/variants.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::campaign {
namespace {

using scenario::Section;

using Rule = decltype(Metric::rule);

std::string in_unit(double value, const Quantity& quantity) {
  return fmt::format("{:g} {}", value / quantity.unit.factor, quantity.unit.name);
}

/// The part of a metric's default name that distinguishes metrics of the same kind and quantity.
std::string subject(const RmsCurve& /*rule*/) { return {}; }
std::string subject(const TimeWithin& rule) { return " " + in_unit(rule.within, *rule.quantity); }
std::string subject(const Lead& rule) {
  return fmt::format(" {} before {}", in_unit(rule.within, *rule.quantity), rule.other);
}
std::string subject(const ValueAt& rule) { return fmt::format(" at {:g} s", seconds(rule.at_us)); }
std::string subject(const Distribution& rule) { return fmt::format(" at {:g} s", seconds(rule.at_us)); }
std::string subject(const Paired& rule) {
  return fmt::format(" at {:g} s against {}", seconds(rule.at_us), rule.other);
}

/// The subject of a rule with a window.
template <class Windowed>
std::string subject(const Windowed& rule) {
  return fmt::format(" {:g} to {:g} s", seconds(rule.from_us), seconds(rule.to_us));
}
std::string subject(const Diverged& rule) {
  const std::string beyond = " beyond " + in_unit(rule.beyond, *rule.quantity);
  return rule.from_us ? fmt::format("{} from {:g} s on", beyond, seconds(*rule.from_us)) : beyond;
}
std::string subject(const ToGo& rule) {
  const std::string window = fmt::format(" {:g} to {:g} s to go", rule.most, rule.least);
  return rule.other.empty() ? window : fmt::format("{} against {}", window, rule.other);
}
std::string subject(const RmsRatio& rule) { return " against " + rule.other; }

/// Rejects a metric that compares a variant with itself, because the result would say nothing about the
/// variant.
void expect_another(Section& section, const Metric& metric, const std::vector<std::string>& variants) {
  const std::string other = other_of(metric);
  if (other.empty()) return;
  const auto& asked = metric.variants;
  const bool alone = asked.empty() && variants.size() == 1;
  if (alone || std::ranges::find(asked, other) != asked.end())
    section.reject("other", fmt::format("'{}' would be compared with itself", other), "another variant");
}

}  // namespace

std::string_view kind(const Metric& metric) { return scenario::kind_of(metric.rule); }

SamplingLimit* sampling_limit_of(Metric& metric) {
  return std::visit(
      [](auto& rule) -> SamplingLimit* {
        if constexpr (requires { rule.sampling; })
          if (rule.sampling.probability) return &rule.sampling;
        return nullptr;
      },
      metric.rule);
}

const Quantity& quantity_of(const Metric& metric) {
  return *std::visit([](const auto& rule) { return rule.quantity; }, metric.rule);
}

std::string other_of(const Metric& metric) {
  return std::visit(
      [](const auto& rule) -> std::string {
        if constexpr (requires { rule.other; }) return rule.other;
        return {};
      },
      metric.rule);
}

std::vector<MetricKind> metric_kinds() {
  return []<std::size_t... i>(std::index_sequence<i...>) {
    return std::vector<MetricKind>{
        {std::variant_alternative_t<i, Rule>::kind, std::variant_alternative_t<i, Rule>::meaning}...};
  }
  (std::make_index_sequence<std::variant_size_v<Rule>>{});
}

Metric read_metric(Section& section, const std::vector<Given>& given, std::int64_t duration_us) {
  const std::vector<std::string> variants = names_of(given);
  Metric metric;
  const std::string wanted = section.one_of({"kind", "Kind of the metric."}, scenario::kinds<Rule>());
  metric.requirement = section.text({"requirement", "Id of the requirement, shown in the reports."}, "");
  metric.variants = read_variants(
      section, "Names of the variants, or of groups of them, that the metric applies to; by default all.",
      given);
  metric.rule = read_metric_rule(section, wanted, {.variants = variants, .duration_us = duration_us});
  expect_another(section, metric, variants);
  const std::string by_default = std::visit(
      [](const auto& rule) { return fmt::format("{} {}{}", rule.kind, rule.quantity->name, subject(rule)); },
      metric.rule);
  metric.name = section.text({"name",
                              "Unique name; by default the kind, the quantity and the values that "
                              "distinguish the metric (time, window, `other`)."},
                             "");
  if (metric.name.empty())
    metric.name = metric.variants.empty()
                      ? by_default
                      : fmt::format("{}: {}", by_default, fmt::join(metric.variants, ", "));
  section.finish();
  return metric;
}

}  // namespace canhil::campaign
