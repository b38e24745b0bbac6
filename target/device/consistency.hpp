// Checks whether an estimator's errors match its covariance: compares the innovations with the covariance
// that the estimator computes for them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace canhil::target {

/// Two control charts of exponentially weighted averages (Roberts, 'Control Chart Tests Based on Geometric
/// Moving Averages', 1959). Each chart updates a sum S by S <- k S + z, where the factor k (`keep`) is less
/// than 1. If the filter is consistent, z has mean 0 and variance 1, so S has the variance 1/(1 - k^2):
///   size   z = (NIS - m)/sqrt(2 m), where the NIS is chi-squared with m degrees of freedom. This chart
///          detects errors that are larger than the covariance indicates.
///   bias   z = an innovation divided by its sigma. This chart detects innovations that are not white because
///          of a lasting error (of a model's coefficient, of a sensor's scale). It does so even if the filter
///          has raised its assumed noise so far that the NIS has its expected value again (Mehra, 'On the
///          Identification of Variances and Adaptive Kalman Filtering', 1970).
/// A NIS below its expected value m raises no alarm, as the errors are then smaller than the covariance
/// indicates.
class ConsistencyMonitor {
 public:
  void reset() { *this = {}; }

  /// Adds the innovation of a measurement that was used or gated: the NIS, and each component of the
  /// innovation divided by the sigma of this component (at most nine components, the same number in every
  /// call). A NaN is treated as the largest value.
  void observe(double nis, std::span<const double> normalised) {
    const auto m = static_cast<double>(normalised.size());
    inconsistent_ = size_.alarmed((nis - m) / std::sqrt(2 * m));
    for (std::size_t i = 0; i < normalised.size(); ++i)
      inconsistent_ = bias_[i].alarmed(normalised[i]) || inconsistent_;
  }

  /// Sets whether the estimator reports that its sigmas are not valid now.
  void distrust(bool distrusted) { distrusted_ = distrusted; }

  [[nodiscard]] bool degraded() const { return inconsistent_ || distrusted_; }

 private:
  // A control chart S with a memory of `updates` updates. The deviation z of a single update is limited to
  // `largest` sigmas. The alarm begins when S exceeds 6 times its standard deviation, and ends after 2 *
  // `updates` consecutive updates with S below 2 times its standard deviation. With `either_side`, |S| is
  // compared instead of S.
  template <int updates, int largest, bool either_side>
  class Chart {
   public:
    bool alarmed(double z) {
      sum_ = keep * sum_ + (z > -largest ? std::min<double>(z, largest) : z <= -largest ? -largest : largest);
      const double level = (either_side ? std::abs(sum_) : sum_) * std::sqrt(1 - keep * keep);
      quiet_ = level < 2 ? quiet_ + 1 : 0;
      if (level > 6) alarm_ = true;
      if (quiet_ >= 2 * updates) alarm_ = false;
      return alarm_;
    }

   private:
    static constexpr double keep = 1 - 1.0 / updates;
    double sum_ = 0;
    int quiet_ = 0;
    bool alarm_ = false;
  };

  // In size_, four outliers in a row raise an alarm, but three do not. The sum S of size_ reaches 6 standard
  // deviations if the mean NIS is 1.8 times its expected value m (for m = 3 degrees of freedom). The sum S of
  // bias_ reaches 6 standard deviations if the mean innovation is 0.19 sigma. If the filter is consistent,
  // one or two of a million updates raise an alarm (5e6 random draws for each of m = 1, 2, 3 and 9).
  Chart<20, 6, false> size_;
  std::array<Chart<500, 4, true>, 9> bias_{};
  bool inconsistent_ = false, distrusted_ = false;
};

}  // namespace canhil::target
