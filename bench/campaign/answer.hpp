// The answer to one question of a campaign: a function a kind of metric.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/campaign/metric.hpp"
#include "bench/campaign/statistics.hpp"

namespace canhil::campaign {

using Runs = std::vector<RunSeries>;

/// Of one metric for one variant.
struct Answer {
  std::string metric;
  std::string kind;
  std::string requirement;
  std::string variant;
  std::string measured{};                                                ///< with its unit
  std::string expected{};                                                ///< the bars in words; empty: none
  std::optional<bool> passed{};                                          ///< none: without a bar
  std::vector<std::pair<std::string, std::optional<double>>> figures{};  ///< by name with unit; none: never
  std::vector<CurvePoint> curve{};                                       ///< of rms_curve, else empty
  const Quantity* quantity = nullptr;
};

/// Fills in what a metric asks of the runs of a variant. `other`: those of the one that it compares with;
/// where it compares with none they are not looked at.
void answer(const Metric& metric, const Runs& runs, const Runs& other, Answer& out);

}  // namespace canhil::campaign
