#include "bench/report/series_bars.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/quantities/list.hpp"

namespace canhil::report {
namespace {

// The window of a bar on the time to go, as times of the run; none: the flight has no samples there.
std::optional<scenario::Window> window_of(const scenario::LosRateError& rule, const run::Run& run) {
  std::optional<scenario::Window> window;
  if (!run.own_truth.engagement) return window;
  for (const world::EngagementTruth& epoch : run.own_truth.engagement->epochs) {
    if (epoch.time_to_go() < rule.least_to_go || epoch.time_to_go() >= rule.most_to_go) continue;
    if (!window) window = scenario::Window{.from_us = epoch.t_us, .to_us = epoch.t_us};
    window->to_us = epoch.t_us;
  }
  return window;
}

using quantities::Quantity;

const Quantity& quantity_of(scenario::AttitudeAxis axis) {
  const std::array all{&quantities::attitude_roll, &quantities::attitude_pitch,
                       &quantities::attitude_heading};
  return *all[static_cast<std::size_t>(axis)];
}
const Quantity& quantity_of(scenario::VelocityAxis axis) {
  const std::array all{&quantities::velocity_north, &quantities::velocity_east, &quantities::velocity_down,
                       &quantities::velocity_norm};
  return *all[static_cast<std::size_t>(axis)];
}
const Quantity& quantity_of(scenario::PositionAxis axis) {
  const std::array all{&quantities::position_north, &quantities::position_east, &quantities::position_down,
                       &quantities::position_horizontal, &quantities::position_norm};
  return *all[static_cast<std::size_t>(axis)];
}
const Quantity& quantity_of(scenario::WindAxis axis) {
  const std::array all{&quantities::wind_along, &quantities::wind_cross, &quantities::wind_down,
                       &quantities::wind_norm};
  return *all[static_cast<std::size_t>(axis)];
}
const Quantity& quantity_of(scenario::LosPlane plane) {
  return plane == scenario::LosPlane::pitch ? quantities::los_rate_pitch : quantities::los_rate_yaw;
}

// Puts the bar of one check on the series that it judges. Rules without a word here judge no course.
class Placer {
 public:
  Placer(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us)
      : all_(all), run_(run), duration_us_(duration_us) {}

  void place(const scenario::Check& check) {
    check_ = &check.name;
    std::visit(*this, check.rule);
  }

  void operator()(const scenario::AttitudeError& rule) {
    put(name(rule.of), quantity_of(rule.axis), rule, "max");
  }
  void operator()(const scenario::VelocityError& rule) {
    put(name(rule.of), quantity_of(rule.axis), rule, "max");
  }
  void operator()(const scenario::PositionError& rule) {
    put(name(scenario::Aligner::inflight_alignment), quantity_of(rule.axis), rule, "max");
  }
  void operator()(const scenario::WindError& rule) {
    put("wind", quantity_of(rule.axis), rule, name(rule.statistic));
  }
  void operator()(const scenario::Convergence& rule) {
    put(name(rule.of), quantity_of(rule.axis), rule.within,
        {.from_us = rule.before_us, .to_us = duration_us_}, "max");
  }
  void operator()(const scenario::LosRateError& rule) {
    using scenario::LosPlane;
    const auto window = window_of(rule, run_);
    const std::string_view statistic = rule.statistic == scenario::LosStatistic::rms ? "rms" : "max";
    for (const LosPlane plane : {LosPlane::pitch, LosPlane::yaw}) {
      if (window && (rule.plane == plane || rule.plane == LosPlane::both))
        put("los_rate", quantity_of(plane), rule.below, *window, statistic);
    }
  }
  void operator()(const auto&) {}

 private:
  void put(std::string_view estimator, const Quantity& quantity, const auto& rule,
           std::string_view statistic) {
    put(estimator, quantity, rule.below, rule.window, statistic);
  }
  void put(std::string_view estimator, const Quantity& quantity, double below_si,
           const scenario::Window& window, std::string_view statistic) {
    for (Series& series : all_) {
      if (series.estimator != estimator || series.about != &quantity || series.kind != Series::Kind::error)
        continue;
      series.bars.push_back({.check = *check_,
                             .statistic = statistic,
                             .below = below_si / series.unit_si,
                             .from_s = static_cast<double>(window.from_us) * 1e-6,
                             .to_s = static_cast<double>(std::min(window.to_us, duration_us_)) * 1e-6});
    }
  }

  std::vector<Series>& all_;
  const run::Run& run_;
  std::int64_t duration_us_;
  const std::string* check_ = nullptr;
};

}  // namespace

void add_bars(std::vector<Series>& all, const scenario::Scenario& scenario, const run::Run& run) {
  Placer placer(all, run, scenario.duration_us);
  for (const scenario::Check& check : scenario.checks) placer.place(check);
}

}  // namespace canhil::report
