// Values of a run put together into as many points as a picture has.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

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

}  // namespace canhil::report
