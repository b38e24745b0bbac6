// A first-order Gauss-Markov process: x' = -x / T + w, in discrete time.
#pragma once

#include <cmath>
#include <limits>

namespace canhil::world {

/// A step of a first-order Gauss-Markov process in its steady state. Exact for every length of the step:
/// x(t + dt) = a x(t) + sigma sqrt(1 - a^2) N(0, 1) with a = exp(-dt / T) (Gelb: Applied Optimal Estimation,
/// eq. (3.8-20)). The step is constant, so both factors are computed once.
struct GaussMarkov {
  /// `steps`: dt / T; infinity: white noise. `sigma`: 1-sigma of x.
  explicit GaussMarkov(double steps, double sigma = 1)
      : kept(std::exp(-steps)), fresh(sigma * std::sqrt(1 - kept * kept)) {}
  /// Each step replaces x by a new random number.
  static GaussMarkov white() { return GaussMarkov(std::numeric_limits<double>::infinity()); }

  /// x after the step. `n`: a standard normal number; x and n are numbers or vectors.
  template <class X>
  [[nodiscard]] X next(const X& x, const X& n) const {
    return kept * x + fresh * n;
  }

  double kept;
  double fresh;
};

}  // namespace canhil::world
