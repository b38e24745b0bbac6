#include "bench/campaign/metric_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "bench/checks/read_quantity.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::campaign {
namespace {

using scenario::Limits;
using scenario::Section;

/// Whether campaigns store a quantity; some quantities exist in single runs only.
bool is_sampled(const Quantity& quantity) {
  if (mapping::find_reference_quantity(quantity.name) != nullptr) return true;
  return std::ranges::any_of(estimators::all(), [&](const estimators::Estimator* one) {
    return quantities::has(one->layout, quantity);
  });
}

/// The quantities of the bench's estimators and those that a mapped target may report.
std::span<const Quantity* const> every_quantity() {
  static const std::vector<const Quantity*> all = [] {
    const auto own = estimators::every_quantity();
    std::vector<const Quantity*> known(own.begin(), own.end());
    for (const mapping::ReferenceQuantity& one : mapping::reference_quantities()) {
      if (std::ranges::find(known, one.quantity) == known.end()) known.push_back(one.quantity);
    }
    return known;
  }();
  return all;
}

/// Reads the key `quantity`: it must be a quantity that campaigns store and that `wanted` accepts.
template <class Wanted>
const Quantity* read_quantity(Section& section, Wanted&& wanted) {
  return checks::read_quantity(section, every_quantity(), [&](const Quantity& one) -> std::string {
    if (!is_sampled(one)) return "exists in single runs only, not in campaigns";
    return wanted(one) ? "" : "cannot be used with this kind";
  });
}

const Quantity* read_error(Section& section) {
  return read_quantity(section, [](const Quantity& one) { return one.degrees_of_freedom == 0; });
}

/// Reads a limit, which may be absent and must not be negative. Its key is `stem` followed by the ending of
/// the unit.
std::optional<double> read_limit(Section& section, const quantities::Unit& unit, std::string_view stem,
                                 std::string_view meaning) {
  return section.optional_number({checks::key_of(stem, unit), meaning, fmt::format("{}_UNIT", stem)},
                                 Limits::at_least(0));
}

/// Rejects the pair of limits STEM_at_least and STEM_at_most (with the suffix `ending`) if no value can meet
/// both limits.
template <class Value>
void expect_bars_ordered(Section& section, std::string_view stem, std::string_view ending,
                         const std::optional<Value>& at_least, const std::optional<Value>& at_most) {
  scenario::expect_ordered(section, fmt::format("{}at_least{}", stem, ending), at_least,
                           fmt::format("{}at_most{}", stem, ending), at_most);
}

/// Reads a limit that the sampling distribution of `what` sets.
SamplingLimit read_sampling(Section& section, std::string_view key, std::string_view meaning) {
  return {.probability = section.optional_number({key, meaning}, Limits::between(0.5, 0.999999)),
          .sharing = 1};
}

/// The limit that a sampling distribution sets and its expectation need each other.
template <class Rule>
void expect_expected(Section& section, std::string_view key, const Rule& rule) {
  if (rule.sampling.probability.has_value() == rule.expected.has_value()) return;
  if (rule.expected)
    section.missing(key, "a probability, because the expected value is given");
  else
    section.missing("expected", "the expected value, because the probability is given");
}

RmsCurve read(Section& section, const MetricContext& /*context*/, RmsCurve rule) {
  rule.quantity = read_error(section);
  return rule;
}

TimeWithin read(Section& section, const MetricContext& /*context*/, TimeWithin rule) {
  rule.quantity = read_error(section);
  rule.within = section.number(
      {checks::key_of("within", rule.quantity->unit), "Bound within which the RMS must stay.", "within_UNIT"},
      Limits::above(0));
  rule.at_most_us = section.optional_time_us(
      {"at_most_s", "Limit: the time is at most this value. The result 'never' does not meet the limit."},
      Limits::at_least(0));
  rule.never_before_us = section.optional_time_us(
      {"never_before_s", "Limit: the time is at least this value. The result 'never' meets the limit."},
      Limits::at_least(0));
  scenario::expect_ordered(section, "never_before_s", rule.never_before_us, "at_most_s", rule.at_most_us);
  return rule;
}

std::int64_t read_at(Section& section, const MetricContext& context) {
  return scenario::read_time(section, {"at_s", "The last update up to this time is used."},
                             Limits::at_least(0), context.duration_us);
}

std::string read_other(Section& section, const MetricContext& context,
                       const std::optional<std::string>& fallback = {}) {
  return section.given_name({"other", "Name of the variant to compare with."}, context.variants, fallback);
}

Lead read(Section& section, const MetricContext& context, Lead rule) {
  rule.quantity = read_error(section);
  rule.within = section.number(
      {checks::key_of("within", rule.quantity->unit), "Bound within which the RMS must stay.", "within_UNIT"},
      Limits::above(0));
  rule.other = read_other(section, context);
  rule.at_least_us =
      section.optional_time_us({"at_least_s", "Limit: the lead is at least this value."}, Limits{});
  return rule;
}

ValueAt read(Section& section, const MetricContext& context, ValueAt rule) {
  rule.quantity = read_error(section);
  rule.at_us = read_at(section, context);
  rule.at_most = read_limit(section, rule.quantity->unit, "at_most", "Limit: the RMS is at most this value.");
  rule.at_least =
      read_limit(section, rule.quantity->unit, "at_least", "Limit: the RMS is at least this value.");
  expect_bars_ordered(section, "", rule.quantity->unit.ending, rule.at_least, rule.at_most);
  return rule;
}

quantities::Unit read_unit(Section& section, const Quantity& quantity) {
  if (quantity.unit.name != "mrad") return quantity.unit;
  const std::vector<std::string> units{"mrad", "deg"};
  return section.one_of({"unit", "Unit of an angle in the result and in the endings of the keys."}, units,
                        "mrad") == "deg"
             ? quantities::degrees
             : quantity.unit;
}

Distribution read(Section& section, const MetricContext& context, Distribution rule) {
  rule.quantity = read_error(section);
  rule.unit = read_unit(section, *rule.quantity);
  rule.at_us = read_at(section, context);
  rule.below =
      read_limit(section, rule.unit, "below",
                 "The fraction of runs is the share of the runs whose absolute value is below this value.");
  rule.rms_at_most = read_limit(section, rule.unit, "rms_at_most", "Limit: the RMS is at most this value.");
  rule.rms_at_least =
      read_limit(section, rule.unit, "rms_at_least", "Limit: the RMS is at least this value.");
  rule.median_at_most =
      read_limit(section, rule.unit, "median_at_most", "Limit: the median is at most this value.");
  rule.median_at_least =
      read_limit(section, rule.unit, "median_at_least", "Limit: the median is at least this value.");
  rule.p90_at_most = read_limit(section, rule.unit, "p90_at_most", "Limit: the p90 is at most this value.");
  rule.fraction_at_least = section.optional_number(
      {"fraction_at_least", "Limit: the fraction of runs is at least this value. Needs `below_UNIT`."},
      Limits::between(0, 1));
  rule.fraction_at_most = section.optional_number(
      {"fraction_at_most", "Limit: the fraction of runs is at most this value. Needs `below_UNIT`."},
      Limits::between(0, 1));
  expect_bars_ordered(section, "rms_", rule.unit.ending, rule.rms_at_least, rule.rms_at_most);
  expect_bars_ordered(section, "median_", rule.unit.ending, rule.median_at_least, rule.median_at_most);
  expect_bars_ordered(section, "fraction_", "", rule.fraction_at_least, rule.fraction_at_most);
  if (!rule.below && (rule.fraction_at_least || rule.fraction_at_most)) {
    section.reject(rule.fraction_at_least ? "fraction_at_least" : "fraction_at_most",
                   "has no effect without a bound", fmt::format("below{} beside it", rule.unit.ending));
  }
  rule.sampling = read_sampling(
      section, "rms_probability",
      "Limit: the RMS lies within the central interval that normal values with the expected RMS (key "
      "`expected_UNIT`) give. The probability is that of meeting all limits `..._probability` of the "
      "campaign.");
  rule.expected = read_limit(section, rule.unit, "expected", "Expected RMS, for `rms_probability`.");
  rule.expected_at_least = read_limit(
      section, rule.unit, "expected_at_least",
      "Smallest expected RMS, for the lower end of the interval. Default: that of `expected_UNIT`.");
  expect_expected(section, "rms_probability", rule);
  rule.batch =
      section
          .optional_integer({"batch",
                             "Number of runs in each bootstrap sample (or the number of all runs, if that is "
                             "smaller). The runs of a sample are drawn with replacement. The 5 % to 95 % "
                             "range is the range of the RMS over these samples. Default: 100."},
                            2)
          .value_or(rule.batch);
  return rule;
}

WindowMoments read(Section& section, const MetricContext& context, WindowMoments rule) {
  rule.quantity = read_error(section);
  const auto [from_us, to_us] = scenario::read_window(section, context.duration_us);
  rule.from_us = from_us;
  rule.to_us = to_us;
  rule.mean_at_most = read_limit(section, rule.quantity->unit, "mean_at_most",
                                 "Limit: the magnitude of the mean is at most this value.");
  rule.standard_deviation_at_most = read_limit(section, rule.quantity->unit, "standard_deviation_at_most",
                                               "Limit: the standard deviation is at most this value.");
  rule.rms_at_most =
      read_limit(section, rule.quantity->unit, "rms_at_most", "Limit: the RMS is at most this value.");
  rule.rms_at_least =
      read_limit(section, rule.quantity->unit, "rms_at_least", "Limit: the RMS is at least this value.");
  expect_bars_ordered(section, "rms_", rule.quantity->unit.ending, rule.rms_at_least, rule.rms_at_most);
  return rule;
}

Paired read(Section& section, const MetricContext& context, Paired rule) {
  rule.quantity = read_error(section);
  rule.other = read_other(section, context);
  rule.at_us = read_at(section, context);
  rule.confidence = section.number({"confidence", "Confidence level of the interval of the fraction."},
                                   Limits::between(0.5, 0.999999), rule.confidence);
  rule.at_most = section.optional_number({"at_most", "Limit: the fraction is at most this value."},
                                         Limits::between(0, 1));
  rule.at_least = section.optional_number({"at_least", "Limit: the fraction is at least this value."},
                                          Limits::between(0, 1));
  expect_bars_ordered(section, "", "", rule.at_least, rule.at_most);
  return rule;
}

Consistency read(Section& section, const MetricContext& context, Consistency rule) {
  rule.quantity = read_quantity(section, [](const Quantity& one) { return one.degrees_of_freedom > 0; });
  const auto [from_us, to_us] = scenario::read_window(section, context.duration_us);
  rule.from_us = from_us;
  rule.to_us = to_us;
  rule.probability = section.number({"probability", "Probability of the central chi-square interval."},
                                    Limits::between(0.5, 0.999999), rule.probability);
  if (section.has("mean_between"))
    rule.mean_between = section.interval({"mean_between", "Limit: the mean lies between these two values."},
                                         Limits::at_least(0));
  section.optional("mean_between");
  rule.sampling = read_sampling(
      section, "mean_probability",
      "Limit: the mean lies in the central interval of chi2(k n)/n over n runs, k degrees of freedom. The "
      "probability is that of meeting all limits `..._probability` of the campaign.");
  rule.expected_at_least = section.number(
      {"expected_at_least",
       "Smallest expected mean, for the lower end of the interval of `mean_probability`. "
       "Default: k."},
      Limits::between(0, rule.quantity->degrees_of_freedom), rule.quantity->degrees_of_freedom);
  rule.inside_at_least = section.optional_number(
      {"inside_at_least", "Limit: the fraction of updates inside the interval is at least this value."},
      Limits::between(0, 1));
  return rule;
}

Diverged read(Section& section, const MetricContext& /*context*/, Diverged rule) {
  rule.quantity = read_error(section);
  rule.beyond = section.number({checks::key_of("beyond", rule.quantity->unit),
                                "An error beyond this value is a divergence.", "beyond_UNIT"},
                               Limits::above(0));
  rule.from_us = section.optional_time_us({"from_s",
                                           "All errors from this time on are judged. Without this key, only "
                                           "the error at the end of each run is judged."},
                                          Limits{});  // samples by time to go have negative times
  if (rule.from_us)
    rule.within_us = section.optional_time_us(
        {"within_s", "Errors count only later than this after the run's first one."}, Limits::at_least(0));
  rule.at_most = section.optional_integer({"at_most", "Limit: the number of runs is at most this value."}, 0);
  rule.at_least = section.optional_integer({"at_least", "Limit: the least number of runs."}, 0);
  rule.at_most_share = section.optional_number(
      {"at_most_share", "Limit: the number of runs is at most this share of the runs, rounded down."},
      Limits::between(0, 1));
  expect_bars_ordered(section, "", "", rule.at_least, rule.at_most);
  if (rule.at_most && rule.at_most_share)
    section.reject("at_most_share", "has no effect beside at_most", "one of the two");
  return rule;
}

RunMean read(Section& section, const MetricContext& context, RunMean rule) {
  rule.quantity = read_error(section);
  const auto [from_us, to_us] = scenario::read_window(section, context.duration_us);
  rule.from_us = from_us;
  rule.to_us = to_us;
  rule.at_most =
      read_limit(section, rule.quantity->unit, "at_most", "Limit: the mean over runs is at most this value.");
  rule.at_least = read_limit(section, rule.quantity->unit, "at_least",
                             "Limit: the mean over runs is at least this value.");
  rule.sampling = read_sampling(
      section, "mean_probability",
      "Limit: the mean over runs differs from the expected mean (key `expected_UNIT`) by no more than its "
      "scatter explains (Student's t). The probability is that of meeting all limits `..._probability` of "
      "the "
      "campaign.");
  rule.expected =
      read_limit(section, rule.quantity->unit, "expected", "Expected mean, for `mean_probability`.");
  expect_expected(section, "mean_probability", rule);
  rule.other = read_other(section, context, "");
  rule.ratio_at_most = section.optional_number(
      {"ratio_at_most",
       "Limit: the mean over runs, divided by that of `other`, is at most this value. Needs `other`."},
      Limits::above(0));
  rule.ratio_at_least = section.optional_number(
      {"ratio_at_least",
       "Limit: the mean over runs, divided by that of `other`, is at least this value. Needs `other`."},
      Limits::above(0));
  expect_bars_ordered(section, "", rule.quantity->unit.ending, rule.at_least, rule.at_most);
  expect_bars_ordered(section, "ratio_", "", rule.ratio_at_least, rule.ratio_at_most);
  if ((rule.ratio_at_most || rule.ratio_at_least) && rule.other.empty()) {
    section.reject(rule.ratio_at_most ? "ratio_at_most" : "ratio_at_least", "has no effect alone",
                   "other = a variant beside it");
  }
  return rule;
}

ToGo read(Section& section, const MetricContext& context, ToGo rule) {
  // Quantities of a whole run have no time to go.
  rule.quantity = read_quantity(section, [](const Quantity& one) {
    return !one.of_whole_run && std::ranges::any_of(estimators::all(), [&](const auto* estimator) {
      return estimator->layout.to_go_stretch_us > 0 && quantities::has(estimator->layout, one);
    });
  });
  std::tie(rule.least, rule.most) =
      section.interval({"time_to_go_s", "Window of the time to go."}, Limits::at_least(0));
  rule.other = read_other(section, context, "");
  rule.rms_at_most =
      read_limit(section, rule.quantity->unit, "rms_at_most", "Limit: the RMS is at most this value.");
  rule.rms_at_least =
      read_limit(section, rule.quantity->unit, "rms_at_least", "Limit: the RMS is at least this value.");
  expect_bars_ordered(section, "rms_", rule.quantity->unit.ending, rule.rms_at_least, rule.rms_at_most);
  const std::string mean_between = checks::key_of("mean_between", rule.quantity->unit);
  if (section.has(mean_between))
    rule.mean_between = section.interval(
        {mean_between, "Limit: the mean lies between these two values.", "mean_between_UNIT"},
        Limits::at_least(0));
  section.optional(mean_between);
  rule.ratio_at_most = section.optional_number(
      {"ratio_at_most", "Limit: the RMS, divided by that of `other`, is at most this value. Needs `other`."},
      Limits::at_least(0));
  rule.ratio_at_least = section.optional_number(
      {"ratio_at_least",
       "Limit: the RMS, divided by that of `other`, is at least this value. Needs `other`."},
      Limits::at_least(0));
  expect_bars_ordered(section, "ratio_", "", rule.ratio_at_least, rule.ratio_at_most);
  if (rule.other.empty() && (rule.ratio_at_most || rule.ratio_at_least)) {
    section.reject(rule.ratio_at_most ? "ratio_at_most" : "ratio_at_least", "has nothing to compare with",
                   "other beside it");
  }
  return rule;
}

RmsRatio read(Section& section, const MetricContext& context, RmsRatio rule) {
  rule.quantity = read_error(section);
  rule.other = read_other(section, context);
  rule.at_most =
      section.optional_number({"at_most", "Limit: the ratio is at most this value."}, Limits::at_least(0));
  return rule;
}

}  // namespace

decltype(Metric::rule) read_metric_rule(Section& section, const std::string& wanted,
                                        const MetricContext& context) {
  return scenario::read_rule<decltype(Metric::rule)>(
      wanted, [&](const auto& rule) { return read(section, context, rule); });
}

}  // namespace canhil::campaign
