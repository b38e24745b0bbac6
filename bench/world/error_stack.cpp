#include "bench/world/error_stack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::world {

// Both orders have the time response of y'' + ... = x for a constant x. Order 1: y' = w (x - y), w = 2 pi f.
// Order 2, with the damping 1/sqrt(2): y'' + sqrt(2) w y' + w^2 y = w^2 x. The difference e = y - x then
// swings with a decay rate equal to its angular frequency, alpha = w / sqrt(2):
//   e(dt)  = exp(-alpha dt) [(cos + sin) e + sin e' / alpha]
//   e'(dt) = exp(-alpha dt) [-2 alpha sin e + (cos - sin) e'],  cos and sin of alpha dt.
Lag::Lag(const ErrorStack& stack, double dt) : order_(stack.bandwidth == 0 ? 0 : stack.order) {
  gain_ = 1 - std::exp(-2 * std::numbers::pi * stack.bandwidth * dt);
  alpha_ = std::numbers::sqrt2 * std::numbers::pi * stack.bandwidth;
  cosine_ = std::exp(-alpha_ * dt) * std::cos(alpha_ * dt);
  sine_ = std::exp(-alpha_ * dt) * std::sin(alpha_ * dt);
}

double Lag::next(double input) {
  if (order_ == 0 || !output_) {
    output_ = input;
  } else if (order_ == 1) {
    *output_ += gain_ * (input - *output_);
  } else {
    const double error = *output_ - input;
    output_ = input + (cosine_ + sine_) * error + sine_ / alpha_ * slope_;
    slope_ = -2 * alpha_ * sine_ * error + (cosine_ - sine_) * slope_;
  }
  return *output_;
}

AxisErrors::AxisErrors(const ErrorStack& stack, double dt, Stream& stream)
    : stack_(stack),
      dt_(dt),
      lag_(stack, dt),
      process_(dt / stack.correlation_s, stack.correlated),
      walk_step_(stack.random_walk * std::sqrt(dt)),
      correlated_(stack.correlated * stream.normal()) {}

void AxisErrors::wander(Stream& stream) {
  correlated_ = process_.next(correlated_, stream.normal());
  walk_ += walk_step_ * stream.normal();
}

double AxisErrors::given(double value) {
  saturated_ = value < stack_.lowest || value > stack_.highest;
  value = std::clamp(value, stack_.lowest, stack_.highest);
  if (stack_.step > 0) value = stack_.step * std::round(value / stack_.step);
  if (stack_.pulse > 0) {
    const double integral = value * dt_ + remainder_;
    const double counted = stack_.pulse * std::round(integral / stack_.pulse);
    remainder_ = integral - counted;
    value = counted / dt_;
  }
  return value;
}

TriadErrors::TriadErrors(const Stacks& stacks, double dt, const Stream& stream)
    : stream_(stream),
      ideal_(std::ranges::all_of(stacks, &ErrorStack::is_ideal)),
      wanders_(std::ranges::any_of(stacks, &ErrorStack::wanders)),
      axes_{AxisErrors(stacks[0], dt, stream_), AxisErrors(stacks[1], dt, stream_),
            AxisErrors(stacks[2], dt, stream_)} {}

Vector3 TriadErrors::lag(const Vector3& input) {
  return {axes_[0].lag(input.x()), axes_[1].lag(input.y()), axes_[2].lag(input.z())};
}

Vector3 TriadErrors::wander() {
  Vector3 sum = Vector3::Zero();
  if (!wanders_) return sum;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].wander(stream_);
    sum[static_cast<Eigen::Index>(i)] = axes_[i].correlated() + axes_[i].walk();
  }
  return sum;
}

Vector3 TriadErrors::given(const Vector3& value) {
  return {axes_[0].given(value.x()), axes_[1].given(value.y()), axes_[2].given(value.z())};
}

bool TriadErrors::is_saturated() const { return std::ranges::any_of(axes_, &AxisErrors::is_saturated); }

}  // namespace canhil::world
