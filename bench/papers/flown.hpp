// The flown campaigns of a paper. Here an answer is the result of a metric for a variant.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/campaign.hpp"
#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/store.hpp"
#include "bench/papers/figure.hpp"
#include "bench/papers/template.hpp"
#include "dbc/text/embedded_file.hpp"

namespace canhil::papers {

struct FlyOptions {
  std::filesystem::path folder;       ///< folder of the results, NAME.sqlite; must exist
  std::optional<std::uint64_t> runs;  ///< replaces the number of runs in the campaigns
  Rounding rounding = Rounding::as_on_the_bus;
  std::function<void(std::string_view campaign, std::size_t done, std::size_t total)> progress;
};

/// A campaign with its answers.
struct Flown {
  std::string name;  ///< name of the campaign's file without extension
  campaign::Campaign campaign;
  campaign::Evaluation evaluation;

  /// RMS over the runs of a variant. `variant` is the name of the variant in the campaign file, followed by
  /// its point of the sweep if the campaign has a sweep: "kf master_ins.period_ms=20". This function and the
  /// next two throw std::logic_error if there is no such result.
  [[nodiscard]] std::span<const campaign::CurvePoint> curve(
      std::string_view variant, const campaign::Quantity& quantity = quantities::attitude_heading) const;
  /// The answer to a metric for a variant.
  [[nodiscard]] const campaign::Answer& answer(std::string_view metric, std::string_view variant) const;
  /// The answer for a variant to the first metric that is of this kind.
  [[nodiscard]] const campaign::Answer& answer_of_kind(std::string_view kind, std::string_view variant) const;
  /// The answers to the metrics with this requirement; empty: there are none.
  [[nodiscard]] std::vector<const campaign::Answer*> answers(std::string_view requirement) const;
};

/// Whether there are answers to metrics with this requirement, and all of these answers meet their limits.
bool passed(const Flown& flown, std::string_view requirement);

/// The campaigns of a paper.
struct Results {
  std::vector<Flown> campaigns;

  /// The campaign of this name; it must exist.
  [[nodiscard]] const Flown& of(std::string_view name) const;
  /// Takes the name of a campaign and then the name of a variant from `words`, and returns their RMS curve.
  [[nodiscard]] std::span<const campaign::CurvePoint> curve(
      Words& words, const campaign::Quantity& quantity = quantities::attitude_heading) const;
};

/// Adds a point to a curve: at x, the RMS over runs, with its 95 % range. The range follows from the scatter
/// between the runs. `unit`: the unit of the figure, expressed in SI.
void add_rms(Curve& curve, double x, const campaign::CurvePoint& point, double unit = 1);
/// The RMS over time [s], every `step`-th point.
Curve over_time(std::span<const campaign::CurvePoint> points, double unit = 1, std::size_t step = 1);

/// The number that an answer has under a name (as in the JSON report); NaN: the answer has no such number.
double figure(const campaign::Answer& answer, std::string_view name);

/// A campaign with the answers computed from its stored results. It is an error if results cannot be read or
/// if runs are missing.
Result<Flown> evaluated(std::string name, campaign::Campaign campaign, const campaign::Store& store);

/// The results file of a campaign in the folder.
std::filesystem::path results_file(const FlyOptions& options, std::string_view campaign);

/// Flies those runs of the campaigns whose results are not yet in the folder. None: `stop` ended the flights
/// early. An error is one line of text.
Result<std::optional<Results>> fly(EmbeddedFiles campaigns, EmbeddedFiles scenarios,
                                   const FlyOptions& options, const std::atomic<bool>& stop);

}  // namespace canhil::papers
