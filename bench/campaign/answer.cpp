#include "bench/campaign/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bench/campaign/divergence.hpp"
#include "bench/campaign/seconds.hpp"
#include "bench/checks/probability.hpp"

namespace canhil::campaign {
namespace {

std::string with_unit(double value, const quantities::Unit& unit) {
  return fmt::format("{:.4g}{}{}", value / unit.factor, unit.name.empty() ? "" : " ", unit.name);
}

/// Converts a value from SI to `unit` and names the value: the name is `stem` followed by the ending of the
/// unit.
std::pair<std::string, std::optional<double>> figure(std::string_view stem, double value,
                                                     const quantities::Unit& unit) {
  return {fmt::format("{}{}", stem, unit.ending), value / unit.factor};
}

std::string time_or_never(std::optional<double> t_s) { return t_s ? fmt::format("{:g} s", *t_s) : "never"; }

/// A note such as " (3 values missing)", which explains why no limit is met; empty if no value is missing.
std::string missing_note(std::size_t missing) {
  return missing == 0 ? "" : fmt::format(" ({} values missing)", missing);
}

/// How a limit is shown, and its unit in numbers.
struct Shown {
  std::function<std::string(double)> words;
  double factor = 1;
  std::string unit{};
};
Shown in(const quantities::Unit& unit) {
  return {.words = [unit](double bar) { return with_unit(bar, unit); },
          .factor = unit.factor,
          .unit = std::string(unit.name)};
}
const Shown percent{.words = [](double fraction) { return fmt::format("{:g} %", 100 * fraction); }};
const Shown times{.words = [](double ratio) { return fmt::format("{:g} times", ratio); }};
const Shown in_seconds{.words = [](double t_s) { return fmt::format("{:g} s", t_s); }, .unit = "s"};
const Shown in_runs{.words = [](double count) { return fmt::format("{:g}", count); }};

/// Collects the limits of an answer. Each call adds a limit as text and records whether the value meets it;
/// the numbers of the answer are those of the limit that is nearest, or furthest exceeded.
class Bars {
 public:
  Bars(Answer& answer, bool complete) : answer_(answer), complete_(complete) {}
  /// `holds`: whether the value meets the limit; none: `value` decides. No value: it was never reached.
  void at_most(std::optional<double> value, const std::optional<double>& bar, const Shown& shown,
               std::string_view what = {}, std::optional<bool> holds = {}) {
    if (!bar) return;
    expect(holds.value_or(value && *value <= *bar), fmt::format("{}at most {}", what, shown.words(*bar)));
    tell(value, {}, bar, shown, what);
  }
  void at_least(std::optional<double> value, const std::optional<double>& bar, const Shown& shown,
                std::string_view what = {}, std::optional<bool> holds = {}, std::string_view text = {}) {
    if (!bar) return;
    expect(holds.value_or(value && *value >= *bar),
           text.empty() ? fmt::format("{}at least {}", what, shown.words(*bar)) : std::string(text));
    tell(value, bar, {}, shown, what);
  }
  void between(double mean, const std::optional<std::pair<double, double>>& ends,
               const quantities::Unit& unit) {
    if (!ends) return;
    const auto [low, high] = *ends;
    expect(mean >= low && mean <= high,
           fmt::format("mean from {:g} to {:g}{}{}", low / unit.factor, high / unit.factor,
                       unit.name.empty() ? "" : " ", unit.name));
    tell(mean, low, high, in(unit), "mean");
  }

 private:
  void expect(bool holds, const std::string& words) {
    answer_.expected += (answer_.expected.empty() ? "" : ", ") + words;
    answer_.passed = answer_.passed.value_or(true) && complete_ && holds;
  }
  void tell(std::optional<double> value, std::optional<double> low, std::optional<double> high,
            const Shown& shown, std::string_view what) {
    const auto limit = [&](const std::optional<double>& bar) -> std::optional<checks::Limit> {
      if (!bar) return std::nullopt;
      return checks::Limit{.value = *bar / shown.factor};
    };
    while (what.ends_with(' ')) what.remove_suffix(1);
    checks::Judgement own{.criterion = {.quantity = std::string(answer_.quantity->name),
                                        .statistic = std::string(what),
                                        .lower = limit(low),
                                        .upper = limit(high),
                                        .unit = shown.unit}};
    if (value && std::isfinite(*value)) own.measurement.value = *value / shown.factor;
    const auto least = checks::margin(answer_.judgement), margin = checks::margin(own);
    const bool first = !answer_.judgement.criterion.lower && !answer_.judgement.criterion.upper;
    if (first || (margin && (!least || *margin < *least))) answer_.judgement = std::move(own);
  }

  Answer& answer_;
  bool complete_;  // false: values are missing, so no limit is met
};

std::size_t missing_in(std::span<const CurvePoint> curve) {
  std::size_t most = 0;
  for (const CurvePoint& point : curve) most = std::max(most, point.missing);
  return most;
}

void answer(const RmsCurve& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  out.curve = rms_curve(runs, *rule.quantity);
  if (out.curve.empty()) {
    out.measured = "no updates";
    return;
  }
  const CurvePoint& last = out.curve.back();
  out.measured = fmt::format("{} updates, {} at the last{}", out.curve.size(),
                             with_unit(last.rms, rule.quantity->unit), missing_note(last.missing));
}

void answer(const TimeWithin& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const auto curve = rms_curve(runs, *rule.quantity);
  const auto t_s = time_within(curve, rule.within);
  const std::size_t missing = missing_in(curve);
  out.measured = time_or_never(t_s) + missing_note(missing);
  out.figures = {{"time_s", t_s}};
  Bars bars(out, missing == 0);
  if (rule.at_most_us) bars.at_most(t_s, seconds(*rule.at_most_us), in_seconds);
  if (rule.never_before_us) {
    const double bar = seconds(*rule.never_before_us);
    bars.at_least(t_s, bar, in_seconds, {}, !t_s || *t_s >= bar, fmt::format("never before {:g} s", bar));
  }
}

void answer(const Lead& rule, const Runs& runs, const Runs& other, Answer& out) {
  const auto own_curve = rms_curve(runs, *rule.quantity), other_curve = rms_curve(other, *rule.quantity);
  const auto own_s = time_within(own_curve, rule.within), other_s = time_within(other_curve, rule.within);
  const std::size_t missing = missing_in(own_curve) + missing_in(other_curve);
  out.figures = {{"time_s", own_s}, {"other_time_s", other_s}};
  if (own_s && other_s) out.figures.emplace_back("lead_s", *other_s - *own_s);
  out.measured =
      fmt::format("{} against {}{}", time_or_never(own_s), time_or_never(other_s), missing_note(missing));
  if (!rule.at_least_us) return;
  const double bar = seconds(*rule.at_least_us);
  constexpr double rounding_s =
      1e-9;  // times are multiples of 1 us, but their difference has rounding errors
  const bool holds = own_s && (!other_s || *other_s - *own_s >= bar - rounding_s);
  const auto lead_s = own_s && other_s ? std::optional(*other_s - *own_s) : std::nullopt;
  Bars(out, missing == 0)
      .at_least(lead_s, bar, in_seconds, "lead", holds, fmt::format("at least {:g} s before", bar));
}

void answer(const ValueAt& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const quantities::Unit& unit = rule.quantity->unit;
  const auto point = value_at(rms_curve(runs, *rule.quantity), rule.at_us);
  const double rms = point ? point->rms : std::nan("");
  const std::size_t missing = point ? point->missing : runs.size();
  out.measured = with_unit(rms, unit) + missing_note(missing);
  out.figures = {figure("rms", rms, unit)};
  Bars bars(out, missing == 0);
  bars.at_most(rms, rule.at_most, in(unit));
  bars.at_least(rms, rule.at_least, in(unit));
}

void answer(const Distribution& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const quantities::Unit& unit = rule.unit;
  const RunDistribution found = run_distribution(runs, *rule.quantity, rule.at_us, rule.below.value_or(0),
                                                 static_cast<std::size_t>(rule.batch));
  out.measured =
      fmt::format("RMS {} (of {} runs: {:.4g} to {:.4g}), median {}, p90 {}", with_unit(found.rms, unit),
                  found.batch, found.rms_low / unit.factor, found.rms_high / unit.factor,
                  with_unit(found.median, unit), with_unit(found.p90, unit));
  if (rule.below)
    out.measured += fmt::format(", below {} in {:.1f} %", with_unit(*rule.below, unit), 100 * found.below);
  out.measured += missing_note(found.missing);
  out.figures = {figure("rms", found.rms, unit),           figure("rms_low", found.rms_low, unit),
                 figure("rms_high", found.rms_high, unit), figure("mean", found.mean, unit),
                 figure("median", found.median, unit),     figure("p90", found.p90, unit)};
  if (rule.below) out.figures.emplace_back("fraction_below", found.below);
  Bars bars(out, found.missing == 0);
  bars.at_most(found.rms, rule.rms_at_most, in(unit), "RMS ");
  bars.at_least(found.rms, rule.rms_at_least, in(unit), "RMS ");
  bars.at_most(found.median, rule.median_at_most, in(unit), "median ");
  bars.at_least(found.median, rule.median_at_least, in(unit), "median ");
  bars.at_most(found.p90, rule.p90_at_most, in(unit), "p90 ");
  const std::string below = rule.below ? fmt::format("below {} in ", with_unit(*rule.below, unit)) : "";
  if (rule.sampling.probability) {
    const auto ends =
        checks::mean_of_squares_bounds(static_cast<double>(runs.size()), 1, rule.sampling.tail());
    bars.at_least(found.rms, rule.expected_at_least.value_or(*rule.expected) * std::sqrt(ends.low), in(unit),
                  "RMS ");
    bars.at_most(found.rms, *rule.expected * std::sqrt(ends.high), in(unit), "RMS ");
  }
  bars.at_least(found.below, rule.fraction_at_least, percent, below);
  bars.at_most(found.below, rule.fraction_at_most, percent, below);
}

void answer(const WindowMoments& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const quantities::Unit& unit = rule.quantity->unit;
  const auto [mean, deviation, count, missing] =
      window_statistics(runs, *rule.quantity, rule.from_us, rule.to_us);
  const auto n = static_cast<double>(count);
  const double rms = std::sqrt(mean * mean + deviation * deviation * (n - 1) / n);
  out.measured = fmt::format("mean {}, standard deviation {}, RMS {}{}", with_unit(mean, unit),
                             with_unit(deviation, unit), with_unit(rms, unit), missing_note(missing));
  out.figures = {figure("mean", mean, unit),
                 figure("standard_deviation", deviation, unit),
                 figure("rms", rms, unit),
                 {"values", static_cast<double>(count)}};
  Bars bars(out, missing == 0);
  bars.at_most(std::abs(mean), rule.mean_at_most, in(unit), "|mean| ");
  bars.at_most(deviation, rule.standard_deviation_at_most, in(unit), "standard deviation ");
  bars.at_most(rms, rule.rms_at_most, in(unit), "RMS ");
  bars.at_least(rms, rule.rms_at_least, in(unit), "RMS ");
}

void answer(const RunMean& rule, const Runs& runs, const Runs& other, Answer& out) {
  const quantities::Unit& unit = rule.quantity->unit;
  const RunMeans found = run_means(runs, *rule.quantity, rule.from_us, rule.to_us);
  const bool scatters = std::isfinite(found.standard_deviation);  // one run has none
  out.measured =
      fmt::format("mean {}, standard deviation {} over runs, largest {}{}", with_unit(found.mean, unit),
                  scatters ? with_unit(found.standard_deviation, unit) : "unknown",
                  with_unit(found.largest, unit), missing_note(found.missing));
  out.figures = {figure("mean", found.mean, unit),
                 figure("standard_deviation", found.standard_deviation, unit),
                 figure("largest", found.largest, unit),
                 {"missing", static_cast<double>(found.missing)}};
  Bars bars(out, found.missing == 0);
  bars.at_most(found.mean, rule.at_most, in(unit));
  bars.at_least(found.mean, rule.at_least, in(unit));
  if (rule.sampling.probability) {
    const auto n = static_cast<double>(runs.size());
    const double away =
        found.standard_deviation / std::sqrt(n) *
        (n < 2 ? std::nan("") : checks::student_t_quantile_above(n - 1, rule.sampling.tail()));
    bars.at_least(found.mean, *rule.expected - away, in(unit));
    bars.at_most(found.mean, *rule.expected + away, in(unit));
  }
  if (rule.other.empty()) return;
  const RunMeans others = run_means(other, *rule.quantity, rule.from_us, rule.to_us);
  const double ratio = found.mean / others.mean;
  out.measured += fmt::format(", {:.3g} times that of {}", ratio, rule.other);
  out.figures.emplace_back("ratio", ratio);
  Bars both(out, found.missing + others.missing == 0);
  const Shown times_other{
      .words = [&](double bar) { return fmt::format("{} {}", times.words(bar), rule.other); }};
  both.at_most(ratio, rule.ratio_at_most, times_other);
  both.at_least(ratio, rule.ratio_at_least, times_other);
}

void answer(const ToGo& rule, const Runs& runs, const Runs& other, Answer& out) {
  const quantities::Unit& unit = rule.quantity->unit;
  const ToGoStatistics found = to_go_statistics(runs, *rule.quantity, rule.least, rule.most);
  out.measured = fmt::format("RMS {}, mean {}", with_unit(found.rms, unit), with_unit(found.mean, unit));
  out.figures = {figure("rms", found.rms, unit), figure("mean", found.mean, unit)};
  std::size_t missing = found.missing;
  double ratio = std::nan("");
  if (!rule.other.empty()) {
    const ToGoStatistics against = to_go_statistics(other, *rule.quantity, rule.least, rule.most);
    ratio = found.rms / against.rms;
    missing += against.missing;
    out.measured += fmt::format(", {:.4g} times that of {}", ratio, rule.other);
    out.figures.emplace_back("ratio", ratio);
  }
  out.measured += missing_note(missing);
  Bars bars(out, missing == 0);
  bars.at_most(found.rms, rule.rms_at_most, in(unit), "RMS ");
  bars.at_least(found.rms, rule.rms_at_least, in(unit), "RMS ");
  bars.between(found.mean, rule.mean_between, unit);
  bars.at_most(ratio, rule.ratio_at_most, times);
  bars.at_least(ratio, rule.ratio_at_least, times);
}

void answer(const RmsRatio& rule, const Runs& runs, const Runs& other, Answer& out) {
  const quantities::Unit& unit = rule.quantity->unit;
  const auto rms_of = [&](const Runs& some) {
    return run_distribution(some, *rule.quantity, std::numeric_limits<std::int64_t>::max(), 0, 1);
  };
  const RunDistribution own = rms_of(runs), against = rms_of(other);
  const double ratio = own.rms / against.rms;
  const std::size_t missing = own.missing + against.missing;
  out.measured = fmt::format("{} against {}: {:.4g} times{}", with_unit(own.rms, unit),
                             with_unit(against.rms, unit), ratio, missing_note(missing));
  out.figures = {{"ratio", ratio}};
  Bars(out, missing == 0).at_most(ratio, rule.at_most, times);
}

// paired_fraction() counts a run without a value as the worst run, so no run is missing here.
void answer(const Paired& rule, const Runs& runs, const Runs& other, Answer& out) {
  const PairedFraction paired = paired_fraction(runs, other, *rule.quantity, rule.at_us, rule.confidence);
  out.measured =
      fmt::format("better in {} of {}: {:.1f} % ({:g} %: {:.1f} to {:.1f} %)", paired.better, paired.pairs,
                  100 * paired.fraction, 100 * rule.confidence, 100 * paired.low, 100 * paired.high);
  out.figures = {{"fraction", paired.fraction},
                 {"low", paired.low},
                 {"high", paired.high},
                 {"pairs", static_cast<double>(paired.pairs)}};
  Bars bars(out, true);
  bars.at_least(paired.fraction, rule.at_least, percent);
  bars.at_most(paired.fraction, rule.at_most, percent);
}

void answer(const Consistency& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const ConsistencyStatistics found =
      consistency(runs, *rule.quantity, rule.from_us, rule.to_us, rule.probability);
  out.measured =
      fmt::format("mean {:.4g}, inside [{:.4g}, {:.4g}] in {:.1f} % of {} updates{}", found.mean, found.low,
                  found.high, 100 * found.inside, found.updates, missing_note(found.missing));
  out.figures = {{"mean", found.mean}, {"low", found.low}, {"high", found.high}, {"inside", found.inside}};
  Bars bars(out, found.missing == 0);
  bars.between(found.mean, rule.mean_between, rule.quantity->unit);
  if (rule.sampling.probability) {
    const double k = rule.quantity->degrees_of_freedom;
    const auto ends =
        checks::mean_of_squares_bounds(static_cast<double>(runs.size()), k, rule.sampling.tail());
    bars.between(found.mean, std::pair(rule.expected_at_least / k * ends.low, ends.high),
                 rule.quantity->unit);
  }
  bars.at_least(found.inside, rule.inside_at_least, percent, "inside in ");
}

void answer(const Diverged& rule, const Runs& runs, const Runs& /*other*/, Answer& out) {
  const Divergence found = divergence(runs, *rule.quantity, rule.beyond, rule.from_us, rule.within_us);
  const std::size_t astray = found.faulted + found.beyond;
  out.measured = fmt::format("{} of {} runs ({} ended early)", astray, found.runs, found.faulted);
  if (rule.from_us) out.measured += ", largest " + with_unit(found.largest, rule.quantity->unit);
  if (rule.within_us) {
    out.measured +=
        fmt::format("; {} ever beyond, {} of them too late to be judged", found.ever_above, found.too_late);
    out.figures = {{"ever_beyond", static_cast<double>(found.ever_above)},
                   {"too_late", static_cast<double>(found.too_late)}};
  }
  out.figures.insert(out.figures.begin(), {{"diverged", static_cast<double>(astray)},
                                           {"faulted", static_cast<double>(found.faulted)}});
  Bars bars(out, true);
  const auto bar = [](const std::optional<std::int64_t>& most) {
    return most ? std::optional(static_cast<double>(*most)) : std::nullopt;
  };
  bars.at_most(static_cast<double>(astray), bar(rule.at_most), in_runs);
  bars.at_least(static_cast<double>(astray), bar(rule.at_least), in_runs);
  if (rule.at_most_share) {
    constexpr double rounding = 1e-9;
    const double share = *rule.at_most_share * static_cast<double>(found.runs);
    bars.at_most(static_cast<double>(astray), std::floor(share + rounding), in_runs);
  }
}

}  // namespace

void answer(const Metric& metric, const Runs& runs, const Runs& other, Answer& out) {
  std::visit(
      [&](const auto& rule) {
        out.quantity = rule.quantity;
        answer(rule, runs, other, out);
      },
      metric.rule);
}

}  // namespace canhil::campaign
