// The integration that the built-in plants share: short steps of the classical fourth-order Runge-Kutta
// method.
#pragma once

#include <cstdint>

namespace canhil::plant {

/// Divides the time between two times [us] into equal parts of at most 1 ms, and calls advance(t, dt) with
/// the begin and the length [s] of each.
template <class Advance>
void in_short_steps(std::int64_t from_us, std::int64_t to_us, const Advance& advance) {
  constexpr std::int64_t longest_us = 1000;
  const std::int64_t steps = (to_us - from_us + longest_us - 1) / longest_us;
  const double dt = 1e-6 * static_cast<double>(to_us - from_us) / static_cast<double>(steps);
  for (std::int64_t i = 0; i < steps; ++i)
    advance(1e-6 * static_cast<double>(from_us) + static_cast<double>(i) * dt, dt);
}

/// The state at t + dt [s], if it is `x` at t and changes by derivative(t, x). State: a vector of Eigen.
template <class State, class Derivative>
State runge_kutta(const State& x, double t, double dt, const Derivative& derivative) {
  const State k1 = derivative(t, x);
  const State k2 = derivative(t + dt / 2, State(x + dt / 2 * k1));
  const State k3 = derivative(t + dt / 2, State(x + dt / 2 * k2));
  const State k4 = derivative(t + dt, State(x + dt * k3));
  return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

}  // namespace canhil::plant
