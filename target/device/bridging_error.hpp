// How wrong the increments are that bridge lost samples of an IMU: the recent samples show it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "target/estimators/strapdown/imu_increment.hpp"

namespace canhil::target {

/// Keeps the latest samples. Lost samples are bridged by the mean of the samples before and after the gap. If
/// the same had been done with any of the samples that did arrive, the error would be known; the mean of the
/// squares of these errors is the variance of a bridge. So vibration counts by what it is, at every frequency
/// and for every length of a gap.
class BridgingError {
 public:
  void reset() { count_ = 0; }

  void take(const strapdown::ImuIncrement& imu) {
    Rates& rates = rates_[count_++ % length];
    rates << imu.delta_theta / imu.dt, imu.delta_v / imu.dt;
  }

  /// The variances of the sums of angles and of velocities over a gap of `missing` samples of dt [s] each, in
  /// rad^2 and (m/s)^2; `before` and `after` are the samples beside the gap.
  [[nodiscard]] std::pair<Eigen::Vector3d, Eigen::Vector3d> of_gap(
      std::size_t missing, double dt, const strapdown::ImuIncrement& before,
      const strapdown::ImuIncrement& after) const {
    const std::size_t kept = std::min(count_, length), first = count_ - kept;
    const std::size_t n = std::min(missing, most_tried);
    Rates squares = Rates::Zero();
    std::size_t tried = 0;
    if (kept >= n + 2) {
      Rates sum = Rates::Zero();  // of the n samples after the sample k
      for (std::size_t i = 1; i <= n; ++i) sum += at(first + i);
      for (std::size_t k = first; k + n + 1 < count_; ++k, ++tried) {
        const Rates& next = at(k + n + 1);
        squares += (sum - static_cast<double>(n) / 2 * (at(k) + next)).cwiseAbs2();
        sum += next - at(k + 1);
      }
    }
    const double scale = static_cast<double>(missing) / static_cast<double>(n);
    Rates variance = squares * (scale * scale / static_cast<double>(std::max<std::size_t>(tried, 1)));
    if (tried < fewest_tried) {  // the start of a run: as wrong as the samples beside the gap differ
      Rates change;
      change << after.delta_theta / after.dt - before.delta_theta / before.dt,
          after.delta_v / after.dt - before.delta_v / before.dt;
      variance += (static_cast<double>(missing) * change).cwiseAbs2();
    }
    variance *= dt * dt;
    return {variance.head<3>(), variance.tail<3>()};
  }

 private:
  using Rates = Eigen::Matrix<double, 6, 1>;  // [rad/s] and [m/s^2]
  static constexpr std::size_t length = 128, most_tried = 64, fewest_tried = 8;

  [[nodiscard]] const Rates& at(std::size_t i) const { return rates_[i % length]; }

  std::array<Rates, length> rates_;
  std::size_t count_ = 0;
};

}  // namespace canhil::target
