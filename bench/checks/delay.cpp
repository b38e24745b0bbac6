#include "bench/checks/delay.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::checks {
namespace {

using quantities::TrackPoint;

constexpr std::size_t fewest = 20;
constexpr double least_s = -0.2, most_s = 1.0, step_s = 0.01;  // limits and step of the search

double seconds(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

// The truth between the answers. A cubic polynomial through the four nearest points gives value and slope.
class Curve {
 public:
  explicit Curve(const Spool<TrackPoint>& points) {
    for (const TrackPoint& one : points) {
      if (!one.truth || (!t_.empty() && seconds(one.t_us) <= t_.back())) continue;
      t_.push_back(seconds(one.t_us));
      x_.push_back(*one.truth);
    }
  }
  [[nodiscard]] bool covers(double t) const { return t_.size() >= 4 && t >= t_.front() && t <= t_.back(); }
  struct At {
    double value = 0, slope = 0;
  };
  /// `after`: an index that the caller sets to 0 before the first call and keeps between the calls. The index
  /// makes each search short, so `t` must not decrease from one call to the next.
  [[nodiscard]] At at(double t, std::ptrdiff_t& after) const {
    while (after < std::ssize(t_) && time(after) <= t) ++after;
    const auto first = std::clamp<std::ptrdiff_t>(after - 2, 0, std::ssize(t_) - 4);
    At at;
    for (std::ptrdiff_t i = first; i < first + 4; ++i) {  // Lagrange
      double basis = 1, slope = 0;
      for (std::ptrdiff_t j = first; j < first + 4; ++j) {
        if (j == i) continue;
        const double width = time(i) - time(j);
        slope = slope * (t - time(j)) / width + basis / width;
        basis *= (t - time(j)) / width;
      }
      at.value += basis * x_[static_cast<std::size_t>(i)];
      at.slope += slope * x_[static_cast<std::size_t>(i)];
    }
    return at;
  }

 private:
  [[nodiscard]] double time(std::ptrdiff_t i) const { return t_[static_cast<std::size_t>(i)]; }
  Spool<double> t_, x_;
};

struct Point {
  double t = 0, estimate = 0;
};

// The fit for one delay, with the best offset.
struct Fit {
  double squares = 0;      // sum of the squared residuals
  double step = 0;         // Gauss-Newton step towards a better delay
  double excitation = 0;   // sum of the squares of (rate of the truth minus mean rate)
  double correlation = 0;  // correlation of successive residuals
};

Fit fit(const Curve& curve, const Spool<Point>& points, double delay) {
  Spool<double> residual, rate;
  std::ptrdiff_t after = 0;
  double mean_residual = 0, mean_rate = 0;
  for (const Point& point : points) {
    const Curve::At at = curve.at(point.t - delay, after);
    residual.push_back(point.estimate - at.value);
    rate.push_back(at.slope);
    mean_residual += residual.back() / static_cast<double>(points.size());
    mean_rate += rate.back() / static_cast<double>(points.size());
  }
  Fit result;
  double cross = 0, lagged = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = residual[i] - mean_residual, g = rate[i] - mean_rate;
    result.squares += r * r;
    result.excitation += g * g;
    cross += r * g;
    if (i > 0) lagged += r * (residual[i - 1] - mean_residual);
  }
  result.step = result.excitation > 0 ? -cross / result.excitation : 0;
  result.correlation = result.squares > 0 ? lagged / result.squares : 0;
  return result;
}

}  // namespace

std::optional<Delay> delay_of(const quantities::Track& track, const scenario::Window& window) {
  const Curve curve(track.points);
  Spool<Point> points;  // only points whose truth is known for every delay that the search tries
  for (const TrackPoint& one : track.points) {
    const double t = seconds(one.t_us);
    const bool inside = one.t_us >= window.from_us && one.t_us <= window.to_us;
    if (inside && one.estimate && std::isfinite(*one.estimate) && curve.covers(t - most_s) &&
        curve.covers(t - least_s))
      points.push_back({.t = t, .estimate = *one.estimate});
  }
  if (points.size() < fewest) return std::nullopt;
  double best = least_s, squares = fit(curve, points, best).squares;
  for (int k = 1; least_s + k * step_s <= most_s; ++k) {
    const double delay = least_s + k * step_s;
    if (const double now = fit(curve, points, delay).squares; now < squares) {
      best = delay;
      squares = now;
    }
  }
  for (int k = 0; k < 5; ++k)
    best = std::clamp(best + std::clamp(fit(curve, points, best).step, -step_s, step_s), least_s, most_s);
  const Fit found = fit(curve, points, best);
  if (found.excitation <= 0) return std::nullopt;
  constexpr double of_95_percent = 1.96;
  const double r = std::clamp(found.correlation, 0.0, 0.999);
  const double variance = found.squares / static_cast<double>(points.size() - 2) / found.excitation;
  const double half_width = of_95_percent * std::sqrt(variance * (1 + r) / (1 - r));
  if (!(half_width <= coarsest_delay_s)) return std::nullopt;
  return Delay{.delay_s = best, .half_width_s = half_width};
}

}  // namespace canhil::checks
