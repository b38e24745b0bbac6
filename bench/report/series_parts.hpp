// What the series of a run are put together from.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/checks/errors.hpp"
#include "bench/report/series.hpp"

namespace canhil::report {

/// One value on its way into a series, in the series' unit.
struct Sample {
  double value = 0;
  std::optional<double> sigma{};
  std::optional<double> truth{};
};

/// The time that a series is about.
struct Span {
  std::int64_t duration_us = 0;  ///< of the run: gives the length of a point's stretch
  std::int64_t end_us = 0;       ///< after which nobody answers
};

/// Puts samples together into stretches of equal length, and leaves a gap where none came for too long.
class Thinned {
 public:
  Thinned(const Span& span, double longest_wait_us)
      : stretch_us_(
            std::max<std::int64_t>(1, span.duration_us / static_cast<std::int64_t>(Series::max_points))),
        end_us_(span.end_us),
        longest_wait_us_(longest_wait_us) {}
  void add(std::int64_t t_us, const Sample& sample) {
    if (!std::isfinite(sample.value)) return;
    if (silent_until(t_us)) points_.push_back(silence_from(last_us_ + 1));
    const std::int64_t stretch = t_us / stretch_us_;
    const bool follows = !points_.empty() && stretch == stretch_ && std::isfinite(points_.back().low);
    stretch_ = stretch;
    last_us_ = t_us;
    if (!follows) {
      points_.push_back(
          {static_cast<double>(t_us) * 1e-6, sample.value, sample.value, sample.sigma, sample.truth});
      return;
    }
    Series::Point& point = points_.back();
    point.low = std::min(point.low, sample.value);
    point.high = std::max(point.high, sample.value);
    if (sample.sigma) point.sigma = std::max(point.sigma.value_or(0), *sample.sigma);
  }
  [[nodiscard]] std::vector<Series::Point> points() && {
    if (silent_until(end_us_)) {
      for (const std::int64_t t_us : {last_us_ + 1, end_us_}) points_.push_back(silence_from(t_us));
    }
    return std::move(points_);
  }

 private:
  [[nodiscard]] bool silent_until(std::int64_t t_us) const {
    return !points_.empty() && static_cast<double>(t_us - last_us_) > longest_wait_us_;
  }
  static Series::Point silence_from(std::int64_t t_us) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {.t_s = static_cast<double>(t_us) * 1e-6, .low = none, .high = none};
  }

  std::int64_t stretch_us_;
  std::int64_t end_us_;
  double longest_wait_us_;
  std::int64_t stretch_ = 0;
  std::int64_t last_us_ = 0;
  std::vector<Series::Point> points_;
};

/// The series with a sample of each item, whose time `time` gives; silence is what lasts longer than the
/// wait.
template <class Items, class Time, class Value>
Series thinned(Series empty, const Span& span, double longest_wait_us, const Items& items, Time time,
               Value value) {
  Thinned points(span, longest_wait_us);
  for (const auto& item : items) points.add(time(item), value(item));
  empty.points = std::move(points).points();
  return empty;
}

/// A normalised innovation squared, and where 95 % of the values of a consistent filter lie.
Series nis_series(std::string_view estimator, const Span& span, double longest_wait_us,
                  const std::vector<checks::Normalised>& nis, double degrees_of_freedom);

/// Names of the quantities that checks judge, as in Series::quantity.
std::string error_of(scenario::AttitudeAxis axis);
std::string error_of(scenario::VelocityAxis axis);
std::string error_of(scenario::PositionAxis axis);
std::string error_of(scenario::WindAxis axis);
std::string error_of(scenario::LosPlane plane);

/// Attitude, velocity, innovations of an estimator of attitude and velocity; of one with fixes its position.
void add_alignment(std::vector<Series>& all, scenario::Aligner aligner, const run::Run& run,
                   std::int64_t duration_us);
void add_wind(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us);
void add_los(std::vector<Series>& all, const run::Run& run, std::int64_t duration_us);

/// Gives each series the bars of the checks that judge it.
void add_bars(std::vector<Series>& all, const scenario::Scenario& scenario, const run::Run& run);

}  // namespace canhil::report
