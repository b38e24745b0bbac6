// The errors of an axis of a sensor that have a memory or belong to its output, in the order in which they
// act: lag, correlated error, random walk, range, steps. Constant errors and white noise are the sensor's
// own. Every sensor that has such errors uses this file.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "bench/world/gauss_markov.hpp"
#include "bench/world/stream.hpp"

namespace canhil::world {

/// The errors of one axis, in the unit of its value.
struct ErrorStack {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  double bandwidth = 0;       ///< at which the amplitude falls to 1/sqrt(2) [Hz]; 0: no lag
  std::int64_t order = 1;     ///< of the lag: 1, or 2 (Butterworth)
  double correlated = 0;      ///< 1-sigma of a first-order Gauss-Markov process
  double correlation_s = 60;  ///< its correlation time [s]
  double random_walk = 0;     ///< 1-sigma after 1 s; grows with the square root of the time
  double lowest = -unlimited, highest = unlimited;  ///< the value saturates there
  double step = 0;                                  ///< of the value; 0: none
  /// A count of the sensor's integrator [unit s]; 0: none. What does not fill a count is in the next sample.
  double pulse = 0;

  /// Whether the axis has a correlated error or a random walk.
  [[nodiscard]] bool wanders() const { return correlated > 0 || random_walk > 0; }
  /// Whether the axis has no error of this kind.
  [[nodiscard]] bool is_ideal() const {
    return bandwidth == 0 && !wanders() && lowest == -unlimited && highest == unlimited && step == 0 &&
           pulse == 0;
  }
};

/// The Allan deviation of a first-order Gauss-Markov process has a maximum of this fraction of its 1-sigma,
/// at 1.89 correlation times (IEEE Std 952-1997, eq. (C.16) and text).
inline constexpr double gauss_markov_peak = 0.6174;

/// A low pass whose input is constant between two samples, which is exact for such an input.
class Lag {
 public:
  /// dt: time from one sample to the next [s].
  Lag(const ErrorStack& stack, double dt);
  /// The output at the sample. The first sample is passed unchanged: the lag begins settled.
  double next(double input);

 private:
  std::int64_t order_;
  double gain_ = 1;                           // of the first order
  double alpha_ = 0, cosine_ = 0, sine_ = 0;  // of the second order
  std::optional<double> output_{};
  double slope_ = 0;  // of the output, second order
};

/// The errors of one axis in a run.
class AxisErrors {
 public:
  /// Draws the start of the correlated error: one number from the stream, whatever the stack is. dt: time
  /// from one sample to the next [s].
  AxisErrors(const ErrorStack& stack, double dt, Stream& stream);

  double lag(double input) { return lag_.next(input); }
  /// Advances the correlated error and the random walk. Takes two numbers from the stream, whatever the stack
  /// is.
  void wander(Stream& stream);
  [[nodiscard]] double correlated() const { return correlated_; }
  [[nodiscard]] double walk() const { return walk_; }
  /// The value that the sensor gives: within its range, in its steps.
  double given(double value);
  /// Whether the latest value was beyond the range.
  [[nodiscard]] bool is_saturated() const { return saturated_; }

 private:
  ErrorStack stack_;
  double dt_;
  Lag lag_;
  GaussMarkov process_;
  double walk_step_;
  double correlated_, walk_ = 0;
  double remainder_ = 0;  // of the last count [unit s]
  bool saturated_ = false;
};

/// The stacks of three axes in a run. Axes without such errors pass their values unchanged, bit for bit; if
/// no axis wanders, no random number is drawn.
class TriadErrors {
 public:
  using Stacks = std::array<ErrorStack, 3>;
  /// `stream`: of these errors alone.
  TriadErrors(const Stacks& stacks, double dt, const Stream& stream);

  /// Whether all axes are ideal.
  [[nodiscard]] bool is_ideal() const { return ideal_; }
  Vector3 lag(const Vector3& input);
  /// The sum of correlated error and random walk of the next sample.
  Vector3 wander();
  Vector3 given(const Vector3& value);
  [[nodiscard]] bool is_saturated() const;

 private:
  Stream stream_;
  bool ideal_, wanders_;
  std::array<AxisErrors, 3> axes_;
};

}  // namespace canhil::world
