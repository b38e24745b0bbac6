#include "bench/report/series.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/checks/probability.hpp"
#include "bench/checks/rule.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/report/summary.hpp"
#include "bench/scenario/quantity.hpp"

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

// Converts a stretch to times of the run; none: the flight has no samples in the stretch.
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

// The limits of the checks that judge the errors of a track.
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
  GrowingSeries series(estimator, track, estimates, scenario);
  series.take(track);
  series.end(track);
  return series.series();
}

// An output of the plant. Each point has the range of the values of a stretch.
class PlantSeries {
 public:
  PlantSeries(std::string name, std::string_view si, std::int64_t duration_us)
      : ending_(scenario::ending_for(si)),
        stretch_us_(std::max<std::int64_t>(1, duration_us / static_cast<std::int64_t>(Series::max_points))),
        series_{.estimator = "plant",
                .name = name,
                .quantity = std::move(name),
                .unit = std::string(ending_.empty() ? "" : scenario::unit_of(ending_)),
                .kind = Series::Kind::estimate} {}

  void take(std::int64_t t_us, double in_si) {
    const double value = in_si / scenario::factor_of(ending_);
    const bool follows = !series_.points.empty() && t_us / stretch_us_ == last_us_ / stretch_us_;
    last_us_ = t_us;
    if (!follows) return series_.points.push_back({.t_s = seconds(t_us), .low = value, .high = value});
    Series::Point& all = series_.points.back();
    all.low = std::min(all.low, value);
    all.high = std::max(all.high, value);
  }
  [[nodiscard]] Series series() && { return std::move(series_); }

 private:
  std::string_view ending_;
  std::int64_t stretch_us_, last_us_ = 0;
  Series series_;
};

std::vector<Series> series_of_plant(const scenario::Scenario& scenario, const drive::Run& run) {
  std::vector<Series> all;
  for (const auto& [facts, record] : plants_of(scenario, run)) {
    if (facts.table != nullptr) continue;
    for (std::size_t column = 0; column < facts.outputs.size(); ++column) {
      const scenario::PlantFacts::Output& output = facts.outputs[column];
      PlantSeries series(output.name, output.si, scenario.duration_us);
      for (std::size_t i = 0; i < record.times_us().size(); ++i)
        series.take(record.times_us()[i], record.value(column, i));
      all.push_back(std::move(series).series());
    }
  }
  return all;
}

}  // namespace

GrowingSeries::GrowingSeries(std::string_view estimator, const Track& track, bool estimates,
                             const scenario::Scenario& scenario)
    : scenario_(scenario),
      unit_(estimates ? track.estimate_unit : track.unit),
      series_{.estimator = std::string(estimator),
              .name = std::string(track.quantity->name),
              .quantity = estimates ? track.estimate_title : track.title,
              .unit = std::string(unit_.name),
              .kind = estimates ? Series::Kind::estimate : kind_of(track)} {
  if (series_.kind != Series::Kind::statistic) return;
  for (const double probability : {0.025, 0.975})
    series_.between.push_back(checks::chi_squared_quantile(track.quantity->degrees_of_freedom, probability));
}

Series::Point GrowingSeries::point_of(const TrackPoint& answer) const {
  const bool estimates = series_.kind == Series::Kind::estimate;
  const double value = (estimates ? answer.estimate.value() : answer.value) / unit_.factor;
  Series::Point point{.t_s = seconds(answer.t_us), .low = value, .high = value};
  (estimates ? point.truth : point.sigma) = in(unit_, estimates ? answer.truth : answer.sigma);
  return point;
}

bool GrowingSeries::silent_until(std::int64_t t_us, const Track& track) const {
  return !series_.points.empty() && static_cast<double>(t_us - last_us_) > track.longest_wait_us;
}

void GrowingSeries::add_silence(std::int64_t from_us) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  series_.points.push_back({.t_s = seconds(from_us), .low = none, .high = none});
}

void GrowingSeries::take(const Track& track, std::int64_t until_us) {
  std::vector<Series::Point>& points = series_.points;
  const std::int64_t stretch_us =
      std::max<std::int64_t>(1, scenario_.duration_us / static_cast<std::int64_t>(Series::max_points));
  const std::int64_t taken_us = last_us_;
  for (const TrackPoint& answer : track.points) {
    if (answer.t_us <= taken_us || answer.t_us > std::min(until_us, track.drawn_until_us)) continue;
    const Series::Point point = point_of(answer);
    if (!std::isfinite(point.low)) continue;
    if (silent_until(answer.t_us, track)) add_silence(last_us_ + 1);
    const bool follows = !points.empty() && answer.t_us / stretch_us == last_us_ / stretch_us &&
                         std::isfinite(points.back().low);
    last_us_ = answer.t_us;
    if (!follows) {
      points.push_back(point);
      continue;
    }
    Series::Point& all = points.back();
    all.low = std::min(all.low, point.low);
    all.high = std::max(all.high, point.high);
    if (point.sigma) all.sigma = std::max(all.sigma.value_or(0), *point.sigma);
  }
  if (series_.kind == Series::Kind::error) series_.bars = bars_of(series_.estimator, track, scenario_);
}

void GrowingSeries::end(const Track& track) {
  if (!silent_until(track.answers_end_us, track)) return;
  add_silence(last_us_ + 1);
  add_silence(track.answers_end_us);
}

void give_tracks(const scenario::Scenario& scenario, const drive::Run& run, const TrackOf& give) {
  if (is_cut_off(run)) return;
  const estimators::Truth truth = drive::truth_of(run.truth, run.per_run_truth, scenario.duration_us);
  for (const estimators::Estimator* one : estimators::in(scenario)) {
    if (!scenario.runs(one->name)) continue;
    estimators::give_tracks(*one, run.seen, truth, [&](const Track& track) { give(one->name, track); });
  }
}

std::vector<OwnPlant> plants_of(const scenario::Scenario& scenario, const drive::Run& run) {
  std::vector<OwnPlant> all;
  if (is_cut_off(run)) return all;
  const drive::PerRunTruth& own = run.per_run_truth;
  for (std::size_t i = 0; i < own.of_tables.size(); ++i) {
    if (own.of_tables[i].is_sampled) all.push_back({scenario.of_tables[i], own.of_tables[i].plant->record()});
  }
  if (own.plant) all.push_back({scenario.plant, own.plant->record()});
  return all;
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
  std::ranges::move(series_of_plant(scenario, run), std::back_inserter(all));
  std::erase_if(all, [](const Series& one) { return one.points.empty(); });
  return all;
}

}  // namespace canhil::report
