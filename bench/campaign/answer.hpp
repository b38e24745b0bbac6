// Evaluates the metrics of a campaign: one function for each kind of metric.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/campaign/metric.hpp"
#include "bench/campaign/statistics.hpp"

namespace canhil::campaign {

using Runs = std::vector<RunSeries>;

/// The result of one metric for one variant. In this folder, 'answer' often means this result, not the
/// messages of the target.
struct Answer {
  std::string metric;
  std::string kind;
  std::string requirement;
  std::string variant;
  std::string measured{};        ///< the result as text, with its unit
  std::string expected{};        ///< the limits as text; empty: no limit
  std::optional<bool> passed{};  ///< none: the metric has no limit
  std::vector<std::pair<std::string, std::optional<double>>>
      figures{};                    ///< results by name and unit; no value: the time was never reached
  std::vector<CurvePoint> curve{};  ///< for rms_curve, otherwise empty
  const Quantity* quantity = nullptr;
};

/// Evaluates a metric for the runs of a variant. If the metric compares this variant with a second variant,
/// `other` contains the runs of the second variant; otherwise `other` is empty.
void answer(const Metric& metric, const Runs& runs, const Runs& other, Answer& out);

}  // namespace canhil::campaign
