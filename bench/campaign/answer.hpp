// What a campaign says of a variant: the results of its metrics, and of its checks. This file evaluates the
// metrics, with one function for each kind.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/campaign/metric.hpp"
#include "bench/campaign/statistics.hpp"
#include "bench/checks/finding.hpp"

namespace canhil::campaign {

using Runs = std::vector<RunSeries>;

/// The result of one metric or check for one variant. In this folder, 'answer' often means this result, not
/// the messages of the target.
struct Answer {
  std::string metric;
  std::string kind;
  std::string requirement;
  std::string variant;
  std::string measured{};  ///< the result as text, with its unit
  std::string expected{};  ///< the limits as text; empty: no limit
  /// None: the metric has no limit, or, if there is an expectation, too many runs were not measured.
  std::optional<bool> passed{};
  checks::Judgement judgement{};  ///< of the limit that is nearest, or furthest exceeded
  std::vector<std::pair<std::string, std::optional<double>>>
      figures{};                       ///< results by name and unit; no value: the time was never reached
  std::vector<CurvePoint> curve{};     ///< for rms_curve, otherwise empty
  const Quantity* quantity = nullptr;  ///< of a metric
  /// None: there is nothing to judge.
  [[nodiscard]] std::optional<checks::Outcome> outcome() const {
    if (expected.empty()) return std::nullopt;
    return !passed ? checks::Outcome::not_measured : checks::pass_if(*passed);
  }
};

/// Evaluates a metric for the runs of a variant. If the metric compares this variant with a second variant,
/// `other` contains the runs of the second variant; otherwise `other` is empty.
void answer(const Metric& metric, const Runs& runs, const Runs& other, Answer& out);

}  // namespace canhil::campaign
