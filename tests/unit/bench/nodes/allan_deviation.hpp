// The Allan deviation of a simulated gyro or accelerometer, and what a datasheet's numbers say it must be.
// This is computed here, independently of the sensor model.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace canhil::sensors {

/// A point of an Allan deviation: the estimate of the variance, from `terms` second differences of the angle
/// that are `m` for each averaging time tau.
struct AllanPoint {
  double tau = 0;  ///< [s]
  double variance = 0;
  std::int64_t m = 0, terms = 0;
};

/// The overlapping Allan variance of the increments of an angle or a velocity, at tau = dt 2^k (IEEE Std
/// 952-1997, annex C). From tau = 16 dt on, the angle is taken at every eighth of tau. So each octave of tau
/// keeps 17 angles, and a sample costs the same for all lengths of a run.
class AllanDeviation {
 public:
  explicit AllanDeviation(double dt) : dt_(dt) {}

  void add(double increment) {
    for (std::size_t level = 0;; ++level) {
      if (level == levels_.size()) levels_.emplace_back();
      Level& one = levels_[level];
      one.angle += increment;
      one.angles[static_cast<std::size_t>(++one.count % kept)] = one.angle;
      for (std::size_t k = level == 0 ? 0 : 3; k < 4; ++k) one.take(k);
      if (one.count % 2 == 1) {
        one.half = increment;
        return;
      }
      increment += one.half;
    }
  }

  /// The points up to the longest tau with at least `least` terms.
  [[nodiscard]] std::vector<AllanPoint> points(std::int64_t least) const {
    std::vector<AllanPoint> all;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      for (std::size_t k = level == 0 ? 0 : 3; k < 4; ++k) {
        const Level& one = levels_[level];
        if (one.terms[k] < least) return all;
        const std::int64_t m = 1LL << k;
        const double tau = dt_ * std::ldexp(static_cast<double>(m), static_cast<int>(level));
        const double mean = one.squares[k] / static_cast<double>(one.terms[k]);
        all.push_back({.tau = tau, .variance = mean / (2 * tau * tau), .m = m, .terms = one.terms[k]});
      }
    }
    return all;
  }

 private:
  static constexpr std::int64_t kept = 17;
  struct Level {
    std::array<double, kept> angles{};  // the latest angles; the first angle, 0, is that at the start
    std::int64_t count = 0;
    double angle = 0, half = 0;
    std::array<double, 4> squares{};
    std::array<std::int64_t, 4> terms{};

    [[nodiscard]] double before(std::int64_t steps) const {
      return angles[static_cast<std::size_t>((count - steps) % kept)];
    }
    void take(std::size_t k) {
      const std::int64_t m = 1LL << k;
      if (count < 2 * m) return;
      const double difference = before(0) - 2 * before(m) + before(2 * m);
      squares[k] += difference * difference;
      ++terms[k];
    }
  };
  double dt_;
  std::vector<Level> levels_;
};

/// The numbers of a datasheet, in SI.
struct Datasheet {
  double random_walk = 0;            // N, of the angle or velocity [unit/sqrt(s)]
  double instability = 0, time = 1;  // 1-sigma [unit/s] and correlation time [s] of a Gauss-Markov process
  double rate_random_walk = 0;       // K [unit/s/sqrt(s)]
  double pulse = 0;                  // of the integrator [unit]

  /// The Allan variance: IEEE Std 952-1997, eq. (C.6), (C.9), (C.16) and (C.4), with Q^2 = pulse^2 / 12.
  [[nodiscard]] double variance(double tau) const {
    const double x = tau / time;
    const double markov =
        2 * instability * instability / x * (1 - (3 - 4 * std::exp(-x) + std::exp(-2 * x)) / (2 * x));
    return random_walk * random_walk / tau + (x > 1e-3 ? markov : instability * instability * 2 * x / 3) +
           rate_random_walk * rate_random_walk * tau / 3 + pulse * pulse / (4 * tau * tau);
  }

  /// The generalised autocovariance of the angle at a lag [s] (Greenhall, Riley: Uncertainty of stability
  /// variances based on finite differences, PTTI 2003): second differences of it are those of the angle.
  [[nodiscard]] double autocovariance(double lag) const {
    const double h = std::abs(lag);
    return -random_walk * random_walk * h / 2 + rate_random_walk * rate_random_walk * h * h * h / 12 -
           instability * instability * time * (time * std::exp(-h / time) + h) +
           (h == 0 ? pulse * pulse / 12 : 0);
  }
};

/// The equivalent degrees of freedom of an estimated Allan variance: 2 E^2 / Var of the mean of the squares
/// of correlated Gaussian differences, summed over their lags. It needs no assumption which noise dominates.
inline double degrees_of_freedom(const Datasheet& sheet, const AllanPoint& point) {
  const double step = point.tau / static_cast<double>(point.m);
  const auto s = [&](std::int64_t lag) { return sheet.autocovariance(static_cast<double>(lag) * step); };
  const auto covariance = [&](std::int64_t lag) {
    const std::int64_t m = point.m;
    return 6 * s(lag) - 4 * (s(lag + m) + s(lag - m)) + s(lag + 2 * m) + s(lag - 2 * m);
  };
  const double at_zero = covariance(0);
  double sum = 1;
  // Differences that are 50 tau apart are independent: those of a Gauss-Markov process fall with exp(-lag /
  // T), and are small where tau is much shorter than T.
  for (std::int64_t lag = 1; lag < std::min(point.terms, 50 * point.m); ++lag) {
    const double rho = covariance(lag) / at_zero;
    sum += 2 * (1 - static_cast<double>(lag) / static_cast<double>(point.terms)) * rho * rho;
  }
  return static_cast<double>(point.terms) / sum;
}

}  // namespace canhil::sensors
