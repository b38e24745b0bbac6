#include "bench/report/series.hpp"

#include <algorithm>

#include "bench/checks/probability.hpp"
#include "bench/report/series_parts.hpp"

namespace canhil::report {
namespace {

std::string plain(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace

std::string error_of(scenario::AttitudeAxis axis) { return plain(name(axis)) + " error"; }
std::string error_of(scenario::VelocityAxis axis) { return "velocity error " + plain(name(axis)); }
std::string error_of(scenario::PositionAxis axis) { return "position error " + plain(name(axis)); }
std::string error_of(scenario::WindAxis axis) { return "wind error " + plain(name(axis)); }
std::string error_of(scenario::LosPlane plane) { return "LOS rate error, " + plain(name(plane)); }

Series nis_series(std::string_view estimator, const Span& span, double longest_wait_us,
                  const std::vector<checks::Normalised>& nis, double degrees_of_freedom) {
  Series empty{.estimator = std::string(estimator),
               .quantity = "normalised innovation squared",
               .unit = "",
               .kind = Series::Kind::statistic};
  for (const double probability : {0.025, 0.975})
    empty.between.push_back(checks::chi_squared_quantile(degrees_of_freedom, probability));
  return thinned(
      std::move(empty), span, longest_wait_us, nis, [](const checks::Normalised& n) { return n.t_us; },
      [](const checks::Normalised& n) { return Sample{.value = n.value}; });
}

std::vector<Series> series(const scenario::Scenario& scenario, const run::Run& run) {
  std::vector<Series> all;
  for (const auto aligner : {scenario::Aligner::transfer_alignment, scenario::Aligner::inflight_alignment}) {
    if (scenario.runs(name(aligner))) add_alignment(all, aligner, run, scenario.duration_us);
  }
  if (run.own_truth.glide && scenario.runs("wind")) add_wind(all, run, scenario.duration_us);
  if (run.own_truth.engagement && scenario.runs("los_rate")) add_los(all, run, scenario.duration_us);
  add_bars(all, scenario, run);
  std::erase_if(
      all, [](const Series& one) { return one.points.empty() || (one.only_if_judged && one.bars.empty()); });
  return all;
}

}  // namespace canhil::report
