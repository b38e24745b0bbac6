// Checks whether an estimator's errors match its covariance: compares the innovations with the covariance
// that the estimator computes for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace canhil::target {

/// Control charts of exponentially weighted averages (Roberts, 'Control Chart Tests Based on Geometric
/// Moving Averages', 1959). Each chart updates a sum S by S <- k S + z, where the factor k (`keep`) is less
/// than 1. If the filter is consistent, z has mean 0 and variance 1, so S has the variance 1/(1 - k^2):
///   size   z = (NIS - m)/sqrt(2 m), where the NIS is chi-squared with m degrees of freedom. This chart
///          detects errors that are larger than the covariance indicates.
///   bias   z = an innovation divided by its sigma. This chart detects innovations that are not white because
///          of a lasting error (of a model's coefficient, of a sensor's scale). It does so even if the filter
///          has raised its assumed noise so far that the NIS has its expected value again (Mehra, 'On the
///          Identification of Variances and Adaptive Kalman Filtering', 1970).
/// A third chart compares the product of each component and its predecessor with the squares: the correlation
/// of successive innovations. It shows within seconds that the noise of a measurement is correlated in time,
/// even if the filter assumes so much noise that its innovations are small. A NIS below its expected value m
/// raises no alarm, as the errors are then smaller than the covariance indicates.
class ConsistencyMonitor {
 public:
  void reset() { *this = {}; }

  /// Adds the innovation of a measurement that was used or gated: the NIS, and each component of the
  /// innovation divided by the sigma of this component (at most nine components, the same number in every
  /// call). A NaN is treated as the largest value. `lasting`: the share of each component's variance that the
  /// estimator expects to come from lasting errors, which it considers; empty: none.
  void observe(double nis, std::span<const double> normalised, std::span<const double> lasting = {}) {
    const auto m = static_cast<double>(normalised.size());
    observe_size(nis, m);
    double share = 0;
    for (std::size_t i = 0; i < normalised.size(); ++i) {
      const double of_this = lasting.empty() ? 0 : lasting[i];
      share += of_this / m;
      // A lasting error is drawn once, so its mean is compared with 2.5 of its sigmas; that of white noise is
      // tested at every update, and compared with 6.
      constexpr double weight = 0.17;  // (2.5/6)^2
      const auto over_mean_of = [&](int updates) {
        return normalised[i] / std::sqrt(1 + weight * of_this * (2 * updates - 1));
      };
      inconsistent_ = bias_[i].alarmed(over_mean_of(bias_updates)) || inconsistent_;
      inconsistent_ = recent_bias_[i].alarmed(over_mean_of(recent_updates)) || inconsistent_;
    }
    inconsistent_ = correlation_.alarmed(normalised, share) || inconsistent_;
  }

  /// Adds only a NIS with m degrees of freedom, for an estimator that does not expect white innovations.
  void observe_size(double nis, double m) { inconsistent_ = size_.alarmed((nis - m) / std::sqrt(2 * m)); }

  /// Sets whether the estimator reports that its sigmas are not valid now.
  void distrust(bool distrusted) { distrusted_ = distrusted; }

  [[nodiscard]] bool degraded() const { return inconsistent_ || distrusted_; }

 private:
  // A control chart S with a memory of `updates` updates. The deviation z of a single update is limited to
  // `largest` sigmas. The alarm begins when S exceeds 6 times its standard deviation, and ends after
  // `quiet_updates` consecutive updates with S below `quiet_level` times its standard deviation. With
  // `either_side`, |S| is compared instead of S.
  template <int updates, int largest, bool either_side, int quiet_updates = 2 * updates, int quiet_level = 2>
  class Chart {
   public:
    bool alarmed(double z) {
      sum_ = keep * sum_ + (z > -largest ? std::min<double>(z, largest) : z <= -largest ? -largest : largest);
      const double level = (either_side ? std::abs(sum_) : sum_) * std::sqrt(1 - keep * keep);
      quiet_ = level < quiet_level ? quiet_ + 1 : 0;
      if (level > 6) alarm_ = true;
      if (quiet_ >= quiet_updates) alarm_ = false;
      return alarm_;
    }

   private:
    static constexpr double keep = 1 - 1.0 / updates;
    double sum_ = 0;
    int quiet_ = 0;
    bool alarm_ = false;
  };

  // The correlation of successive innovations over `updates` updates. For a consistent filter with m
  // components, it has the mean 0 and the variance 1/(2 updates m).
  template <int updates>
  class Correlation {
   public:
    bool alarmed(std::span<const double> z, double expected) {
      double product = 0, square = 0;
      for (std::size_t i = 0; i < z.size(); ++i) {
        const double now = z[i] > -largest ? std::min(z[i], largest) : z[i] <= -largest ? -largest : largest;
        product += now * before_[i];
        square += now * now;
        before_[i] = now;
      }
      products_ = keep * products_ + product;
      squares_ = keep * squares_ + square;
      usual_squares_ = keep * usual_squares_ + static_cast<double>(z.size());
      counted_ = std::min(counted_ + 1, 4 * updates);
      const double level = (products_ - expected * usual_squares_) / squares_;
      const double deviation = 1 / std::sqrt(std::min(2 * updates, counted_) * static_cast<double>(z.size()));
      quiet_ = level < 2 * deviation ? quiet_ + 1 : 0;
      if (level > 6 * deviation && squares_ > least_squares * usual_squares_) alarm_ = true;
      if (quiet_ >= 2 * updates) alarm_ = false;
      return alarm_;
    }

   private:
    static constexpr double keep = 1 - 1.0 / updates, largest = 4;
    static constexpr double least_squares = 0.05;  // with smaller innovations, sigmas are too large
    std::array<double, 9> before_{};
    double products_ = 0, squares_ = 0;
    double usual_squares_ = 0;  // the mean of squares_ in a consistent filter
    int counted_ = 0, quiet_ = 0;
    bool alarm_ = false;
  };

  // In size_, four outliers in a row raise an alarm, but three do not. The sum S of size_ reaches 6 standard
  // deviations if the mean NIS is 1.8 times its expected value m (for m = 3 degrees of freedom). The sum S of
  // bias_ reaches 6 standard deviations if the mean innovation is 0.19 sigma. If the filter is consistent,
  // one or two of a million updates raise an alarm (5e6 random draws for each of m = 1, 2, 3 and 9).
  static constexpr int bias_updates = 500, recent_updates = 50;
  Chart<20, 6, false> size_;
  std::array<Chart<bias_updates, 4, true>, 9> bias_{};
  std::array<Chart<recent_updates, 4, true, 2 * bias_updates, 4>, 9> recent_bias_{};
  Correlation<50> correlation_;
  bool inconsistent_ = false, distrusted_ = false;
};

}  // namespace canhil::target
