// The [[metric]] tables of a campaign: what is evaluated, and the limits that turn the results into a
// verdict. A new kind of metric needs a struct here, a reader in metric.cpp and an evaluation in answer.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bench/campaign/series.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::campaign {

/// A limit that the sampling distribution sets. All such limits of a campaign share the probability: if
/// everything is as expected, all are met with `probability`.
struct SamplingLimit {
  std::optional<double> probability;  ///< none: no limit
  std::size_t sharing = 1;            ///< such limits of the campaign: one for each metric and variant
  /// The probability of either side, of one limit.
  [[nodiscard]] double tail() const { return (1 - *probability) / 2 / static_cast<double>(sharing); }
};

/// RMS over runs as a function of time; only for reports, without a limit.
struct RmsCurve {
  static constexpr std::string_view kind = "rms_curve";
  static constexpr std::string_view meaning = "RMS over runs as a function of time. This kind has no limits.";
  const Quantity* quantity = &quantities::attitude_heading;
};

/// The time from which the RMS over runs stays within a limit.
struct TimeWithin {
  static constexpr std::string_view kind = "time_within";
  static constexpr std::string_view meaning =
      "Time of the first update from which the RMS over runs stays within `within_UNIT` until the end; "
      "'never' if there is no such update.";
  const Quantity* quantity = &quantities::attitude_heading;
  double within = 0;                            ///< [SI]
  std::optional<std::int64_t> at_most_us;       ///< limit; a time that is never reached does not meet it
  std::optional<std::int64_t> never_before_us;  ///< limit; a time that is never reached meets it
};

/// How much earlier the RMS of a variant comes within a limit, and stays there until the end, than the RMS of
/// the variant `other`.
struct Lead {
  static constexpr std::string_view kind = "lead";
  static constexpr std::string_view meaning =
      "Lead over the variant `other`: how much earlier the RMS over runs comes within `within_UNIT` and "
      "stays there until the end.";
  const Quantity* quantity = &quantities::attitude_heading;
  double within = 0;  ///< [SI]
  std::string other;
  std::optional<std::int64_t> at_least_us;
};

/// RMS over runs at a given time. If there is no update at this time, the last update before it counts.
struct ValueAt {
  static constexpr std::string_view kind = "value_at";
  static constexpr std::string_view meaning = "RMS over runs at the last update up to `at_s`.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::int64_t at_us = 0;
  std::optional<double> at_most, at_least;  ///< [SI]
};

/// The distribution of |quantity| over runs at a time. Each run contributes its last update up to that time.
struct Distribution {
  static constexpr std::string_view kind = "distribution";
  static constexpr std::string_view meaning =
      "For each run, the absolute value at the last update up to `at_s` is taken. The results are statistics "
      "of these values over runs: RMS with its 5 % to 95 % range, median, p90, mean, and the fraction of "
      "runs below `below_UNIT`.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::int64_t at_us = 0;
  quantities::Unit unit;        ///< mrad or deg for angles
  std::optional<double> below;  ///< the fraction of runs below this value is reported [SI]
  std::int64_t batch = 100;     ///< number of runs for the bootstrap range of the RMS
  std::optional<double> rms_at_most, rms_at_least, median_at_most, median_at_least, p90_at_most;  ///< [SI]
  std::optional<double> fraction_at_least, fraction_at_most;
  SamplingLimit sampling;                             ///< of the RMS of normal values
  std::optional<double> expected, expected_at_least;  ///< RMS, for `sampling` [SI]
};

/// Mean, standard deviation and RMS over all runs and updates in a time window.
struct WindowMoments {
  static constexpr std::string_view kind = "window";
  static constexpr std::string_view meaning =
      "Mean, standard deviation and RMS over all runs and all updates in a time window.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::int64_t from_us = 0, to_us = 0;
  std::optional<double> mean_at_most;  ///< limit of |mean| [SI]
  std::optional<double> standard_deviation_at_most, rms_at_most, rms_at_least;
};

/// For each run, the mean of |quantity| over a time window. The results are the mean and the standard
/// deviation of these means over runs.
struct RunMean {
  static constexpr std::string_view kind = "run_mean";
  static constexpr std::string_view meaning =
      "For each run, the mean of the absolute value over a window is computed. The results are the mean and "
      "the standard deviation of these means over runs.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::int64_t from_us = 0, to_us = 0;
  std::optional<double> at_most, at_least;              ///< limits of the mean over runs [SI]
  std::string other;                                    ///< empty: no comparison
  std::optional<double> ratio_at_most, ratio_at_least;  ///< limits of the mean divided by the mean of `other`
  SamplingLimit sampling;                               ///< of the mean over runs
  std::optional<double> expected;                       ///< mean, for `sampling` [SI]
};

/// RMS and mean over runs in a window of the time to go, and the RMS divided by the RMS of another variant.
struct ToGo {
  static constexpr std::string_view kind = "to_go";
  static constexpr std::string_view meaning =
      "RMS and mean over all runs and over a window of the time to go.";
  const Quantity* quantity = nullptr;               ///< a quantity of an estimator with samples by time to go
  double least = 0, most = 0;                       ///< [s]
  std::string other;                                ///< empty: no comparison
  std::optional<double> rms_at_most, rms_at_least;  ///< [SI]
  std::optional<std::pair<double, double>> mean_between;
  std::optional<double> ratio_at_most, ratio_at_least;  ///< limits of the RMS divided by the RMS of `other`
};

/// Takes the value at the end of each run, and divides the RMS of these values by the same RMS of the variant
/// `other`.
struct RmsRatio {
  static constexpr std::string_view kind = "rms_ratio";
  static constexpr std::string_view meaning =
      "RMS over runs of the value at the end of each run, divided by the same RMS of the variant `other`.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::string other;
  std::optional<double> at_most;
};

/// Fraction of runs in which |quantity| is smaller than in the run of the variant `other` that has the same
/// random numbers.
struct Paired {
  static constexpr std::string_view kind = "paired";
  static constexpr std::string_view meaning =
      "Fraction of runs in which the absolute error is smaller than in the same run of the variant `other`, "
      "with the Clopper-Pearson interval of this fraction.";
  const Quantity* quantity = &quantities::attitude_heading;
  std::string other;
  std::int64_t at_us = 0;
  double confidence = 0.95;
  std::optional<double> at_least, at_most;  ///< limits of the fraction
};

/// Mean NEES or NIS with chi-square bounds.
struct Consistency {
  static constexpr std::string_view kind = "consistency";
  static constexpr std::string_view meaning =
      "Mean NEES or NIS, and the fraction of updates at which the mean over runs lies in the central "
      "chi-square interval.";
  const Quantity* quantity = &quantities::innovation_nis;
  std::int64_t from_us = 0, to_us = 0;
  double probability = 0.95;
  std::optional<std::pair<double, double>> mean_between;
  SamplingLimit sampling;        ///< of the mean, with one independent value in each run
  double expected_at_least = 0;  ///< smallest expected mean, for `sampling`
  std::optional<double>
      inside_at_least;  ///< required fraction of the updates whose mean lies within the bounds
};

/// Number of diverged runs. A run has diverged if it ended early or if its error is beyond a limit at the end
/// of the run. With from_us, an error beyond the limit at any time after from_us is enough.
struct Diverged {
  static constexpr std::string_view kind = "divergence";
  static constexpr std::string_view meaning =
      "Number of runs that ended early, or whose error is beyond `beyond_UNIT` or is not a number.";
  const Quantity* quantity = &quantities::attitude_heading;
  double beyond = 0;                    ///< [SI]
  std::optional<std::int64_t> from_us;  ///< none: only the end of a run is judged
  /// With `from_us`: an error counts only if it is later than this after the run's first one beyond the
  /// limit.
  std::optional<std::int64_t> within_us;
  std::optional<std::int64_t> at_most, at_least;  ///< limits of the number of runs
  std::optional<double> at_most_share;            ///< the same as a share of the runs
};

struct Metric {
  std::string name;                   ///< unique; default: kind, quantity and subject()
  std::string requirement;            ///< id for the reports; may be empty
  std::vector<std::string> variants;  ///< names as in the file, before the sweep; empty: all
  std::variant<RmsCurve, TimeWithin, Lead, ValueAt, Distribution, WindowMoments, Paired, Consistency,
               Diverged, ToGo, RmsRatio, RunMean>
      rule;
};

std::string_view kind(const Metric& metric);
/// The metric's limit from the sampling distribution; nullptr: it has none.
SamplingLimit* sampling_limit_of(Metric& metric);
const Quantity& quantity_of(const Metric& metric);
/// The name, in the campaign file, of the variant with which a metric compares; empty: the metric compares
/// with no variant.
std::string other_of(const Metric& metric);

/// The name of a kind of metric, and what the kind evaluates.
struct MetricKind {
  std::string_view name, meaning;
};
std::vector<MetricKind> metric_kinds();

struct Given;
/// `given`: the variants that the metric may name; `duration_us`: the shortest duration of these variants.
Metric read_metric(scenario::Section& section, const std::vector<Given>& given, std::int64_t duration_us);

}  // namespace canhil::campaign
