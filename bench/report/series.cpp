#include "bench/report/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/checks/probability.hpp"
#include "bench/checks/rule.hpp"
#include "bench/estimators/registry.hpp"

namespace canhil::report {
namespace {

using quantities::Track;
using quantities::TrackPoint;

double seconds(std::int64_t t_us) { return static_cast<double>(t_us) * 1e-6; }

std::optional<double> in(const quantities::Unit& unit, const std::optional<double>& value) {
  return value ? std::optional(*value / unit.factor) : std::nullopt;
}

Series::Kind kind_of(const Track& track) {
  return track.kind == Track::Kind::innovation  ? Series::Kind::innovation
         : track.kind == Track::Kind::statistic ? Series::Kind::statistic
                                                : Series::Kind::error;
}

// The points of a track combined into stretches of equal length, with a gap where answers are missing for too
// long.
template <class PointOf>
std::vector<Series::Point> thinned(const Track& track, std::int64_t duration_us, PointOf point_of) {
  const std::int64_t stretch_us =
      std::max<std::int64_t>(1, duration_us / static_cast<std::int64_t>(Series::max_points));
  std::vector<Series::Point> points;
  std::int64_t last_us = 0;
  const auto silent_until = [&](std::int64_t t_us) {
    return !points.empty() && static_cast<double>(t_us - last_us) > track.longest_wait_us;
  };
  const auto add_silence = [&points](std::int64_t from_us) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    points.push_back({.t_s = seconds(from_us), .low = none, .high = none});
  };
  for (const TrackPoint& answer : track.points) {
    if (answer.t_us > track.drawn_until_us) continue;
    const Series::Point point = point_of(answer);
    if (!std::isfinite(point.low)) continue;
    if (silent_until(answer.t_us)) add_silence(last_us + 1);
    const bool follows = !points.empty() && answer.t_us / stretch_us == last_us / stretch_us &&
                         std::isfinite(points.back().low);
    last_us = answer.t_us;
    if (!follows) {
      points.push_back(point);
      continue;
    }
    Series::Point& all = points.back();
    all.low = std::min(all.low, point.low);
    all.high = std::max(all.high, point.high);
    if (point.sigma) all.sigma = std::max(all.sigma.value_or(0), *point.sigma);
  }
  if (silent_until(track.answers_end_us)) {
    add_silence(last_us + 1);
    add_silence(track.answers_end_us);
  }
  return points;
}

// A stretch as times of the run; none: the flight has no samples there.
std::optional<scenario::Window> window_of(const checks::Stretch& stretch, const Track& track) {
  if (!stretch.to_go_s) return stretch.window;
  std::optional<scenario::Window> window;
  for (const auto& [t_us, to_go_s] : track.to_go) {
    if (to_go_s < stretch.to_go_s->first || to_go_s >= stretch.to_go_s->second) continue;
    if (!window) window = scenario::Window{.from_us = t_us, .to_us = t_us};
    window->to_us = t_us;
  }
  return window;
}

// The bars of the checks that judge the errors of a track.
std::vector<Series::Bar> bars_of(std::string_view estimator, const Track& track,
                                 const scenario::Scenario& scenario) {
  std::vector<Series::Bar> bars;
  if (track.kind != Track::Kind::error) return bars;
  for (const scenario::Check& check : scenario.checks) {
    const std::optional<checks::Bar> bar = check.rule->bar();
    if (!bar || std::ranges::none_of(bar->judged, [&](const checks::Subject& subject) {
          return subject.estimator == estimator && subject.quantity == track.quantity;
        }))
      continue;
    const auto window = window_of(bar->stretch, track);
    if (!window) continue;
    bars.push_back({.check = check.name,
                    .statistic = bar->statistic,
                    .below = bar->below / track.unit.factor,
                    .from_s = seconds(window->from_us),
                    .to_s = seconds(std::min(window->to_us, scenario.duration_us))});
  }
  return bars;
}

// The values of a track, or its estimates together with the truth.
Series series_of(std::string_view estimator, const Track& track, bool estimates,
                 const scenario::Scenario& scenario) {
  const quantities::Unit& unit = estimates ? track.estimate_unit : track.unit;
  Series series{.estimator = std::string(estimator),
                .about = track.quantity,
                .quantity = estimates ? track.estimate_title : track.title,
                .unit = std::string(unit.name),
                .kind = estimates ? Series::Kind::estimate : kind_of(track)};
  series.points = thinned(track, scenario.duration_us, [&](const TrackPoint& answer) {
    const double value = (estimates ? answer.estimate.value() : answer.value) / unit.factor;
    Series::Point point{.t_s = seconds(answer.t_us), .low = value, .high = value};
    (estimates ? point.truth : point.sigma) = in(unit, estimates ? answer.truth : answer.sigma);
    return point;
  });
  if (!estimates) series.bars = bars_of(estimator, track, scenario);
  if (series.kind == Series::Kind::statistic) {
    for (const double probability : {0.025, 0.975})
      series.between.push_back(checks::chi_squared_quantile(track.quantity->degrees_of_freedom, probability));
  }
  return series;
}

}  // namespace

void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give) {
  const estimators::Truth truth = drive::truth_of(run.truth, run.per_run_truth, scenario.duration_us);
  for (const estimators::Estimator* one : estimators::in(scenario)) {
    if (!scenario.runs(one->name)) continue;
    estimators::give_tracks(*one, run.seen, truth, [&](const Track& track) { give(one->name, track); });
  }
}

std::vector<Series> series(const scenario::Scenario& scenario, const drive::Run& run) {
  std::vector<Series> all;
  std::ptrdiff_t estimates_end = 0;  // an estimator's estimates come before its other series
  give_tracks(scenario, run, [&](std::string_view estimator, const Track& track) {
    if (all.empty() || all.back().estimator != estimator) estimates_end = std::ssize(all);
    if (!track.estimate_title.empty())
      all.insert(all.begin() + estimates_end++, series_of(estimator, track, true, scenario));
    Series values = series_of(estimator, track, false, scenario);
    if (!track.only_if_judged || !values.bars.empty()) all.push_back(std::move(values));
  });
  std::erase_if(all, [](const Series& one) { return one.points.empty(); });
  return all;
}

}  // namespace canhil::report
