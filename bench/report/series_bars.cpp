#include "bench/report/series_bars.hpp"

#include <algorithm>
#include <optional>

#include "bench/checks/rule.hpp"

namespace canhil::report {
namespace {

// A stretch as times of the run; none: the flight has no samples there.
std::optional<scenario::Window> window_of(const checks::Stretch& stretch, const Series& series) {
  if (!stretch.to_go_s) return stretch.window;
  std::optional<scenario::Window> window;
  for (const auto& [t_us, to_go_s] : series.to_go) {
    if (to_go_s < stretch.to_go_s->first || to_go_s >= stretch.to_go_s->second) continue;
    if (!window) window = scenario::Window{.from_us = t_us, .to_us = t_us};
    window->to_us = t_us;
  }
  return window;
}

}  // namespace

void add_bars(std::vector<Series>& all, const scenario::Scenario& scenario) {
  for (const scenario::Check& check : scenario.checks) {
    const std::optional<checks::Bar> bar = check.rule->bar();
    if (!bar) continue;
    for (Series& series : all) {
      const bool judged = std::ranges::any_of(bar->of, [&](const checks::Subject& subject) {
        return series.kind == Series::Kind::error && series.estimator == subject.estimator &&
               series.about == subject.quantity;
      });
      const auto window = window_of(bar->stretch, series);
      if (!judged || !window) continue;
      series.bars.push_back(
          {.check = check.name,
           .statistic = bar->statistic,
           .below = bar->below / series.unit_si,
           .from_s = static_cast<double>(window->from_us) * 1e-6,
           .to_s = static_cast<double>(std::min(window->to_us, scenario.duration_us)) * 1e-6});
    }
  }
}

}  // namespace canhil::report
