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
///
/// Errors of bridges add up where samples are lost in step with a vibration. What the variance of their sum
/// grows by with each gap is var e(t) + 2 sum cov(e(t), e(t_i)) over the earlier gaps t_i; the correlation of
/// errors that are so far apart is that of the errors that are known.
class BridgingError {
 public:
  void reset() {
    count_ = 0;
    gaps_ = 0;
    owed_.setZero();
  }

  void take(const strapdown::ImuIncrement& imu) {
    Rates& rates = rates_[count_++ % length];
    rates << imu.delta_theta / imu.dt, imu.delta_v / imu.dt;
  }

  /// What a gap of `missing` samples of dt [s] each adds to the variances of the sums of angles and of
  /// velocities, in rad^2 and (m/s)^2; `before` and `after` are the samples beside the gap.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> of_gap(std::size_t missing, double dt,
                                                     const strapdown::ImuIncrement& before,
                                                     const strapdown::ImuIncrement& after) {
    const std::size_t n = std::min(missing, most_tried), tried = try_bridges(n);
    const Rates squares = sum_of_products(tried, 0);
    const double scale = dt * static_cast<double>(missing) / static_cast<double>(n);
    Rates variance = squares * (scale * scale / static_cast<double>(std::max<std::size_t>(tried, 1)));
    if (tried < fewest_tried) {  // the start of a run: as wrong as the samples beside the gap differ
      Rates change;
      change << after.delta_theta / after.dt - before.delta_theta / before.dt,
          after.delta_v / after.dt - before.delta_v / before.dt;
      variance += (dt * static_cast<double>(missing) * change).cwiseAbs2();
    }
    const Rates sigma = variance.cwiseSqrt();
    for (std::size_t i = gaps_; i > 0 && i + most_gaps > gaps_; --i) {
      const Gap& earlier = gap_[(i - 1) % most_gaps];
      const std::size_t apart = count_ - earlier.at;
      if (apart >= tried) break;
      const Rates correlation =
          (squares.array() > 0).select(sum_of_products(tried, apart).cwiseQuotient(squares), 0);
      variance += 2 * correlation.cwiseProduct(sigma).cwiseProduct(earlier.sigma);
    }
    gap_[gaps_++ % most_gaps] = {.at = count_, .sigma = sigma};
    // If the sum's variance shrinks, later gaps add less.
    variance += owed_;
    owed_ = variance.cwiseMin(0);
    variance = variance.cwiseMax(0);
    return {variance.head<3>(), variance.tail<3>()};
  }

 private:
  using Rates = Eigen::Matrix<double, 6, 1>;  // [rad/s] and [m/s^2]
  struct Gap {
    std::size_t at = 0;           // the number of samples before it
    Rates sigma = Rates::Zero();  // of the error of its bridge
  };
  static constexpr std::size_t length = 128, most_tried = 64, fewest_tried = 8, most_gaps = 16;

  // Bridges each n of the kept samples by their neighbours; keeps the errors [rad/s, m/s^2 times n].
  std::size_t try_bridges(std::size_t n) {
    const std::size_t kept = std::min(count_, length), first = count_ - kept;
    if (kept < n + 2) return 0;
    Rates sum = Rates::Zero();  // of the n samples after the sample k
    for (std::size_t i = 1; i <= n; ++i) sum += at(first + i);
    std::size_t tried = 0;
    for (std::size_t k = first; k + n + 1 < count_; ++k) {
      const Rates& next = at(k + n + 1);
      errors_[tried++] = sum - static_cast<double>(n) / 2 * (at(k) + next);
      sum += next - at(k + 1);
    }
    return tried;
  }

  // The sum of the products of errors that are `apart` samples apart.
  [[nodiscard]] Rates sum_of_products(std::size_t tried, std::size_t apart) const {
    Rates sum = Rates::Zero();
    for (std::size_t k = 0; k + apart < tried; ++k) sum += errors_[k].cwiseProduct(errors_[k + apart]);
    return sum;
  }

  [[nodiscard]] const Rates& at(std::size_t i) const { return rates_[i % length]; }

  std::array<Rates, length> rates_, errors_;
  std::size_t count_ = 0;
  std::array<Gap, most_gaps> gap_;
  std::size_t gaps_ = 0;
  Rates owed_ = Rates::Zero();
};

}  // namespace canhil::target
