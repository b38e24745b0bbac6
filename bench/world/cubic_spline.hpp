// The natural cubic spline through values at given times. Its first two derivatives are continuous; beyond
// its ends it is linear.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace canhil::world {

template <int n>
class CubicSpline {
 public:
  using Value = Eigen::Matrix<double, n, 1>;
  struct Point {
    Value value = Value::Zero();
    Value rate = Value::Zero();       ///< [1/s]
    Value rate_rate = Value::Zero();  ///< [1/s^2]
  };

  CubicSpline() = default;
  /// times [s]: ascending, as many as values, at least one.
  CubicSpline(std::vector<double> times, std::vector<Value> values)
      : times_(std::move(times)), values_(std::move(values)), bends_(values_.size(), Value::Zero()) {
    assert(times_.size() == values_.size() && !times_.empty());
    solve();
  }

  [[nodiscard]] Point at(double t) const {
    if (times_.size() < 2) return times_.empty() ? Point{} : Point{.value = values_.front()};
    const double inside = std::clamp(t, times_.front(), times_.back());
    const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, inside);
    const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i];
    const double b = (inside - times_[i]) / h, a = 1 - b;
    Point point;
    point.value = a * values_[i] + b * values_[i + 1] +
                  (h * h / 6) * ((a * a * a - a) * bends_[i] + (b * b * b - b) * bends_[i + 1]);
    point.rate = (values_[i + 1] - values_[i]) / h +
                 (h / 6) * ((3 * b * b - 1) * bends_[i + 1] - (3 * a * a - 1) * bends_[i]);
    point.rate_rate = a * bends_[i] + b * bends_[i + 1];
    if (t != inside) {
      point.value += (t - inside) * point.rate;
      point.rate_rate.setZero();
    }
    return point;
  }

  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  // Computes the second derivatives M at the knots (bends_) by elimination (Thomas). M is 0 at the two ends.
  // If 0, 1 and 2 are the numbers of any three successive knots, then
  // h0 M0 + 2 (h0 + h1) M1 + h1 M2 = 6 ((y2 - y1) / h1 - (y1 - y0) / h0).
  void solve() {
    if (times_.size() < 3) return;
    std::vector<double> above(times_.size(), 0);
    for (std::size_t i = 1; i + 1 < times_.size(); ++i) {
      const double h0 = times_[i] - times_[i - 1], h1 = times_[i + 1] - times_[i];
      const Value right = 6 * ((values_[i + 1] - values_[i]) / h1 - (values_[i] - values_[i - 1]) / h0);
      const double pivot = 2 * (h0 + h1) - h0 * above[i - 1];
      above[i] = h1 / pivot;
      bends_[i] = (right - h0 * bends_[i - 1]) / pivot;
    }
    for (std::size_t i = times_.size() - 2; i > 0; --i) bends_[i] -= above[i] * bends_[i + 1];
  }

  std::vector<double> times_;
  std::vector<Value> values_;
  std::vector<Value> bends_;
};

}  // namespace canhil::world
