#include "bench/checks/delay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bench/quantities/unwrapped.hpp"

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
      if (!one.truth || !std::isfinite(*one.truth) || (!t_.empty() && seconds(one.t_us) <= t_.back()))
        continue;
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

// The fit for one delay, with the best offset. Squares are sums over the points, of deviations from the mean.
struct Fit {
  double delay = 0;
  double squares = 0;     // of the residuals
  double step = 0;        // Gauss-Newton step towards a better delay
  double excitation = 0;  // squares of the rate of the truth
  double movement = 0;    // squares of the truth
  double slope = 0;  // of the regression of the estimates on the truth: 1 if they follow it, 0 if they do not
  double correlation = 0;  // of successive residuals
};

Fit fit(const Curve& curve, const Spool<Point>& points, double delay) {
  Spool<double> residual, rate, truth;
  std::ptrdiff_t after = 0;
  double mean_residual = 0, mean_rate = 0, mean_truth = 0;
  const auto count = static_cast<double>(points.size());
  for (const Point& point : points) {
    const Curve::At at = curve.at(point.t - delay, after);
    residual.push_back(point.estimate - at.value);
    rate.push_back(at.slope);
    truth.push_back(at.value);
    mean_residual += residual.back() / count;
    mean_rate += rate.back() / count;
    mean_truth += truth.back() / count;
  }
  Fit result{.delay = delay};
  double by_rate = 0, by_truth = 0, lagged = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = residual[i] - mean_residual, g = rate[i] - mean_rate, x = truth[i] - mean_truth;
    result.squares += r * r;
    result.excitation += g * g;
    result.movement += x * x;
    by_rate += r * g;
    by_truth += r * x;
    if (i > 0) lagged += r * (residual[i - 1] - mean_residual);
  }
  result.step = result.excitation > 0 ? -by_rate / result.excitation : 0;
  result.slope = result.movement > 0 ? 1 + by_truth / result.movement : 0;
  result.correlation = result.squares > 0 ? lagged / result.squares : 0;
  return result;
}

// The best fit near a delay.
Fit refined(const Curve& curve, const Spool<Point>& points, double delay) {
  for (int k = 0; k < 5; ++k)
    delay = std::clamp(delay + std::clamp(fit(curve, points, delay).step, -step_s, step_s), least_s, most_s);
  return fit(curve, points, delay);
}

// The best fit of all delays that the search tries, and the best one at another minimum.
struct Search {
  Fit best;
  std::optional<Fit> other{};
};

Search search(const Curve& curve, const Spool<Point>& points) {
  std::vector<double> squares;
  const auto delay_at = [](std::size_t k) { return least_s + step_s * static_cast<double>(k); };
  for (std::size_t k = 0; delay_at(k) <= most_s + 0.5 * step_s; ++k)
    squares.push_back(fit(curve, points, std::min(delay_at(k), most_s)).squares);
  std::vector<Fit> minima;
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const bool falls = k == 0 || squares[k] <= squares[k - 1];
    const bool rises = k + 1 == squares.size() || squares[k] < squares[k + 1];
    if (falls && rises) minima.push_back(refined(curve, points, std::min(delay_at(k), most_s)));
  }
  std::ranges::sort(minima, {}, &Fit::squares);
  Search found{.best = minima.front()};
  const auto apart = std::ranges::find_if(
      minima, [&](const Fit& one) { return std::abs(one.delay - found.best.delay) > 2 * step_s; });
  if (apart != minima.end()) found.other = *apart;
  return found;
}

// The points of a window whose truth is known for every delay that the search tries. The errors of an angle
// are unwrapped: a target that is late by more than half a turn has a large error, not a small one.
Spool<Point> points_of(const quantities::Track& track, const scenario::Window& window, const Curve& curve,
                       std::size_t& answers) {
  const bool angle = quantities::si_name(track.quantity->unit) == "rad";
  Spool<Point> points;
  double last_error = 0;
  for (const TrackPoint& one : track.points) {
    const bool inside = one.t_us >= window.from_us && one.t_us <= window.to_us;
    if (!inside || !one.estimate || !std::isfinite(*one.estimate)) continue;
    ++answers;
    const double t = seconds(one.t_us);
    if (!one.truth || !curve.covers(t - most_s) || !curve.covers(t - least_s)) continue;
    double error = *one.estimate - *one.truth;
    if (angle) error = last_error = quantities::unwrapped(error, last_error);
    points.push_back({.t = t, .estimate = *one.truth + error});
  }
  return points;
}

}  // namespace

Result<Delay> delay_of(const quantities::Track& track, const scenario::Window& window) {
  const Curve curve(track.points);
  std::size_t answers = 0;
  const Spool<Point> points = points_of(track, window, curve, answers);
  if (points.size() < fewest)
    return failure(fmt::format(
        "too few answers: {} of {} in the window have {:g} s of truth before them and {:g} s after "
        "them, expected {}",
        points.size(), answers, most_s, -least_s, fewest));
  const auto [best, other] = search(curve, points);
  const auto count = static_cast<double>(points.size());
  const auto rms = [&](double squares) { return std::sqrt(squares / count); };
  // The truth is computed with a relative rounding of 1e-16, and its rate from steps of some milliseconds.
  double largest = 1;
  for (const Point& point : points) largest = std::max(largest, std::abs(point.estimate));
  const double still = 1e-9 * largest;  // [SI], and [SI/s]
  if (rms(best.excitation) < still)
    return failure(rms(best.movement) < still
                       ? "the truth is constant"
                       : "the truth changes at a constant rate, so a delay looks like an offset");
  constexpr double of_95_percent = 1.96;
  const double r = std::clamp(best.correlation, 0.0, 0.999);
  const double uncorrelated = best.squares / (count - 2);  // variance of the residuals
  const double variance = uncorrelated * (1 + r) / (1 - r);
  const double half_width = of_95_percent * std::sqrt(variance / best.excitation);
  const double slope_half_width = of_95_percent * std::sqrt(uncorrelated / best.movement);
  constexpr double follows = 0.5;  // below: a constant fits the answers better than the truth does
  if (best.slope + slope_half_width < follows)
    return failure(
        fmt::format("the answers do not follow the truth: their slope against it is {:.2f}", best.slope));
  constexpr double margin_s = 1e-6;
  const bool at_the_end = best.delay < least_s + margin_s || best.delay > most_s - margin_s;
  // If noise decides where the minimum is, the end of the search says nothing.
  if (at_the_end && of_95_percent * std::sqrt(uncorrelated / best.excitation) <= coarsest_delay_s)
    return failure(fmt::format("the best delay is at the end of the search, {:g} ms", best.delay * 1e3));
  const quantities::Unit& unit = track.quantity->unit;
  if (!(half_width <= coarsest_delay_s))
    return failure(
        fmt::format("too uncertain, {:.1f} +- {:.1f} ms: the answers scatter by {:.3g} {}, the rate of "
                    "the truth by {:.3g} {} per s",
                    best.delay * 1e3, half_width * 1e3, rms(best.squares) / unit.factor, unit.name,
                    rms(best.excitation) / unit.factor, unit.name));
  // Two delays fit equally well if their squares differ by less than the 95 % interval of the best, or by
  // less than a hundredth of the movement.
  if (other && other->squares - best.squares <
                   std::max(of_95_percent * of_95_percent * variance, 0.01 * best.movement))
    return failure(fmt::format("the truth repeats itself: {:.1f} ms and {:.1f} ms fit equally well",
                               best.delay * 1e3, other->delay * 1e3));
  return Delay{.delay_s = best.delay, .half_width_s = half_width};
}

}  // namespace canhil::checks
