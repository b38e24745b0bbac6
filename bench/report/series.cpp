#include "bench/report/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "bench/checks/errors.hpp"
#include "bench/checks/los.hpp"
#include "bench/checks/probability.hpp"
#include "bench/checks/wind.hpp"
#include "bench/world/units.hpp"

namespace canhil::report {
namespace {

using checks::Observations;
using world::units::deg;
using world::units::mrad;
using Kind = Series::Kind;

// Puts samples together into stretches of equal length.
class Thinned {
 public:
  explicit Thinned(std::int64_t duration_us)
      : stretch_us_(std::max<std::int64_t>(1, duration_us / static_cast<std::int64_t>(Series::max_points))) {}
  void add(std::int64_t t_us, double value, std::optional<double> sigma = std::nullopt) {
    if (!std::isfinite(value)) return;
    const std::int64_t stretch = t_us / stretch_us_;
    if (points_.empty() || stretch != stretch_) {
      points_.push_back({static_cast<double>(t_us) * 1e-6, value, value, sigma});
      stretch_ = stretch;
      return;
    }
    Series::Point& point = points_.back();
    point.low = std::min(point.low, value);
    point.high = std::max(point.high, value);
    if (sigma) point.sigma = std::max(point.sigma.value_or(0), *sigma);
  }
  [[nodiscard]] std::vector<Series::Point> points() && { return std::move(points_); }

 private:
  std::int64_t stretch_us_;
  std::int64_t stretch_ = 0;
  std::vector<Series::Point> points_;
};

std::vector<double> chi_squared_95(double degrees_of_freedom) {
  return {checks::chi_squared_quantile(degrees_of_freedom, 0.025),
          checks::chi_squared_quantile(degrees_of_freedom, 0.975)};
}

// The samples of `items`: `value` gives the value, or the value and its sigma.
template <class Items, class Time, class Value>
Series thinned(Series series, std::int64_t duration_us, const Items& items, Time time, Value value) {
  Thinned points(duration_us);
  for (const auto& item : items) std::apply([&](auto... v) { points.add(time(item), v...); }, value(item));
  series.points = std::move(points).points();
  return series;
}

constexpr auto t_us = [](const auto& item) { return item.t_us; };
constexpr auto cause_us = [](const auto& item) { return item.cause_us; };
constexpr std::array axes{"north", "east", "down"};

Series nis_series(std::string_view estimator, std::int64_t duration_us,
                  const std::vector<checks::Normalised>& nis, double degrees_of_freedom) {
  Series empty{.estimator = std::string(estimator),
               .quantity = "normalised innovation squared",
               .unit = "",
               .kind = Kind::statistic,
               .points = {},
               .between = chi_squared_95(degrees_of_freedom)};
  return thinned(std::move(empty), duration_us, nis, t_us,
                 [](const checks::Normalised& n) { return std::tuple(n.value); });
}

// An error with the sigma of the last filter answer before it.
template <class Answers, class Error, class Sigma>
Series navigation_series(Series empty, std::int64_t duration_us,
                         const std::vector<checks::NavigationError>& errors, const Answers& answers,
                         Error error, Sigma sigma) {
  auto next = answers.begin();
  return thinned(std::move(empty), duration_us, errors, t_us, [&](const checks::NavigationError& e) {
    while (next != answers.end() && next->cause_us <= e.t_us) ++next;
    return std::tuple(error(e), next == answers.begin() ? std::optional<double>()
                                                        : std::optional<double>(sigma(*std::prev(next))));
  });
}

double misalignment_sigma(const checks::FilterAnswer& answer, int axis) {
  return answer.attitude_sigma(axis);
}
double misalignment_sigma(const checks::FixAnswer& answer, int axis) {
  return axis == 0 ? answer.tilt_sigma_north : axis == 1 ? answer.tilt_sigma_east : answer.heading_sigma;
}

template <class Answers>
void add_alignment(std::vector<Series>& all, scenario::Aligner aligner, const run::Run& run,
                   std::int64_t duration_us, const Answers& answers) {
  const bool by_fixes = aligner == scenario::Aligner::inflight_alignment;
  const std::string estimator(name(aligner));
  const auto errors = checks::navigation_errors(checks::navigation_of(run.seen, aligner), run.truth);
  const double unit = by_fixes ? deg : mrad;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string about = axes[static_cast<std::size_t>(axis)];
    all.push_back(navigation_series(
        {.estimator = estimator,
         .quantity = "attitude error about " + about,
         .unit = by_fixes ? "deg" : "mrad",
         .points = {},
         .between = {}},
        duration_us, errors, answers, [&](const auto& e) { return e.misalignment(axis) / unit; },
        [&](const auto& a) { return misalignment_sigma(a, axis) / unit; }));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string along = axes[static_cast<std::size_t>(axis)];
    all.push_back(navigation_series(
        {.estimator = estimator,
         .quantity = "velocity error " + along,
         .unit = "m/s",
         .points = {},
         .between = {}},
        duration_us, errors, answers, [&](const auto& e) { return e.v_eb_n(axis); },
        [&](const auto& a) { return a.velocity_sigma(axis); }));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string along = axes[static_cast<std::size_t>(axis)];
    all.push_back(thinned({.estimator = estimator,
                           .quantity = "innovation " + along,
                           .unit = by_fixes ? "m" : "m/s",
                           .kind = Kind::innovation,
                           .points = {},
                           .between = {}},
                          duration_us, answers, cause_us,
                          [&](const auto& a) { return std::tuple(a.innovation(axis)); }));
  }
  all.push_back(nis_series(estimator, duration_us, checks::nis(run.seen, aligner), 3));
}

void add_position(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us) {
  std::vector<checks::FixAnswer> told;
  std::ranges::copy_if(run.seen.fixes, std::back_inserter(told),
                       [&](const auto& fix) { return checks::tells_of_its_time(fix, run.truth); });
  for (int axis = 0; axis < 3; ++axis) {
    const std::string along = axes[static_cast<std::size_t>(axis)];
    all.push_back(thinned({.estimator = "inflight_alignment",
                           .quantity = "position error " + along,
                           .unit = "m",
                           .points = {},
                           .between = {}},
                          duration_us, told, cause_us, [&](const checks::FixAnswer& fix) {
                            return std::tuple(checks::position_error(fix, run.truth)(axis),
                                              std::optional(fix.position_sigma(axis)));
                          }));
  }
}

// The answer of a cause, of answers in the order of their causes.
template <class Answers>
auto answer_at(const Answers& answers, std::int64_t t) {
  return std::ranges::lower_bound(answers, t, {}, cause_us);
}

void add_wind(std::vector<Series>& all, const Observations& seen, const world::GlideRecord& glide,
              std::int64_t duration_us) {
  const auto errors = checks::wind_errors(seen, glide);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string along = axes[static_cast<std::size_t>(axis)];
    all.push_back(thinned(
        {.estimator = "wind", .quantity = "wind error " + along, .unit = "m/s", .points = {}, .between = {}},
        duration_us, errors, t_us, [&](const checks::WindError& e) {
          return std::tuple(e.error_n(axis), std::optional(answer_at(seen.wind, e.t_us)->sigma(axis)));
        }));
  }
  all.push_back(nis_series("wind", duration_us, checks::wind_nis(seen), 9));
}

void add_los(std::vector<Series>& all, const Observations& seen, const world::EngagementRecord& engagement,
             std::int64_t duration_us) {
  auto errors = checks::los_errors(seen, engagement);
  // In the last moments before the passage the rate itself grows beyond any picture.
  constexpr double least_to_go_s = 0.08;
  std::erase_if(errors, [](const checks::LosError& e) { return e.time_to_go < least_to_go_s; });
  for (const auto& [plane, member] :
       {std::pair("pitch", &world::Planes<double>::pitch), std::pair("yaw", &world::Planes<double>::yaw)}) {
    all.push_back(thinned({.estimator = "los_rate",
                           .quantity = std::string("LOS rate error, ") + plane,
                           .unit = "mrad/s",
                           .points = {},
                           .between = {}},
                          duration_us, errors, t_us, [&, member = member](const checks::LosError& e) {
                            return std::tuple(
                                e.rate.*member / mrad,
                                std::optional(answer_at(seen.los, e.t_us)->rate_sigma.*member / mrad));
                          }));
  }
  all.push_back(nis_series("los_rate", duration_us, checks::los_nis(seen), 2));
}

}  // namespace

std::vector<Series> series(const scenario::Scenario& scenario, const run::Run& run) {
  std::vector<Series> all;
  const std::int64_t duration_us = scenario.duration_us;
  if (scenario.runs("transfer_alignment"))
    add_alignment(all, scenario::Aligner::transfer_alignment, run, duration_us, run.seen.filter);
  if (scenario.runs("inflight_alignment")) {
    add_alignment(all, scenario::Aligner::inflight_alignment, run, duration_us, run.seen.fixes);
    add_position(all, run, duration_us);
  }
  if (run.own_truth.glide && scenario.runs("wind"))
    add_wind(all, run.seen, *run.own_truth.glide, duration_us);
  if (run.own_truth.engagement && scenario.runs("los_rate"))
    add_los(all, run.seen, *run.own_truth.engagement, duration_us);
  std::erase_if(all, [](const Series& one) { return one.points.empty(); });
  return all;
}

}  // namespace canhil::report
