#include "bench/world/motion/recorded.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace canhil::world {
namespace {

using Vector4 = Eigen::Vector4d;

double seconds(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

std::vector<double> times_of(std::span<const RecordedState> states) {
  std::vector<double> times;
  times.reserve(states.size());
  for (const RecordedState& state : states) times.push_back(seconds(state.t_us));
  return times;
}

CubicSpline<3> velocity_of(std::span<const RecordedState> states) {
  std::vector<Vector3> values;
  values.reserve(states.size());
  for (const RecordedState& state : states) values.push_back(state.v_eb_n);
  return {times_of(states), std::move(values)};
}

// q and -q are the same rotation, so each quaternion gets the sign that brings it nearer to the previous one.
CubicSpline<4> quaternion_of(std::span<const RecordedState> states) {
  std::vector<Vector4> values;
  values.reserve(states.size());
  for (const RecordedState& state : states) {
    const Vector4 next = Eigen::Quaterniond(state.C_bn).coeffs();
    const bool turned = !values.empty() && next.dot(values.back()) < 0;
    values.push_back(turned ? Vector4(-next) : next);
  }
  return {times_of(states), std::move(values)};
}

}  // namespace

RecordedPath::RecordedPath(std::span<const RecordedState> states, const Position& start)
    : velocity_(velocity_of(states)), quaternion_(quaternion_of(states)) {
  t_us_.reserve(states.size());
  for (const RecordedState& state : states) t_us_.push_back(state.t_us);
  const bool has_positions = states.front().position.has_value();
  integrate(has_positions ? *states.front().position : start);
  if (!has_positions) return;
  // The first pass leaves a residual, because NED axes rotate along the path. The second pass removes it.
  for (int pass = 0; pass < 2; ++pass) correct(states);
  find_contradiction(states);
}

Vector3 RecordedPath::velocity(double t) const { return velocity_.at(t).value + correction_.at(t).rate; }

Movement RecordedPath::movement(double t) const {
  const auto velocity = velocity_.at(t);
  const auto correction = correction_.at(t);
  const auto quaternion = quaternion_.at(t);
  const Eigen::Quaterniond q(quaternion.value), rate(quaternion.rate);
  // The derivative q' of a unit quaternion q is q (0, omega / 2). Therefore the rate of the normalised
  // quaternion is the vector part of 2 q* q' / |q|^2.
  return {.v_eb_n = velocity.value + correction.rate,
          .v_eb_n_rate = velocity.rate + correction.rate_rate,
          .C_bn = q.normalized().toRotationMatrix(),
          .omega_nb_b = 2 / q.squaredNorm() * (q.conjugate() * rate).vec()};
}

Position RecordedPath::position(double t) const {
  const auto& times = velocity_.times();
  const auto after = std::upper_bound(times.begin() + 1, times.end(), t);
  const auto before = static_cast<std::size_t>(after - times.begin()) - 1;
  return advanced_from(positions_[before], times[before], t);
}

std::vector<std::int64_t> RecordedPath::samples_between(std::int64_t from_us, std::int64_t to_us) const {
  const auto first = std::ranges::upper_bound(t_us_, from_us);
  const auto last = std::ranges::lower_bound(first, t_us_.end(), to_us);
  return {first, last};
}

Position RecordedPath::advanced_from(const Position& position, double from, double to) const {
  return advanced(position, velocity(from), velocity(0.5 * (from + to)), velocity(to), to - from);
}

void RecordedPath::integrate(const Position& start) {
  const auto& times = velocity_.times();
  positions_.assign(1, start);
  for (std::size_t i = 1; i < times.size(); ++i)
    positions_.push_back(advanced_from(positions_.back(), times[i - 1], times[i]));
}

// Divides the flight into equal stretches. Adds the mean position residual of each stretch to the correction
// at the middle of the stretch.
void RecordedPath::correct(std::span<const RecordedState> states) {
  const auto& times = velocity_.times();
  const double length = times.back() - times.front();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::floor(length / averaged_s)));
  const double stretch = length / static_cast<double>(count);
  std::vector<Vector3> sums(count, Vector3::Zero());
  std::vector<double> weights(count, 0), middles;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto index = std::min(count - 1, static_cast<std::size_t>((times[i] - times.front()) / stretch));
    sums[index] += displacement_n(positions_[i], *states[i].position);
    ++weights[index];
  }
  for (std::size_t index = 0; index < count; ++index) {
    middles.push_back(times.front() + (static_cast<double>(index) + 0.5) * stretch);
    sums[index] = sums[index] / weights[index] + correction_.at(middles.back()).value;
  }
  const Vector3 before = correction_.at(times.front()).value;
  correction_ = CubicSpline<3>(std::move(middles), std::move(sums));
  integrate(displaced(positions_.front(), correction_.at(times.front()).value - before));
}

void RecordedPath::find_contradiction(std::span<const RecordedState> states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double position = displacement_n(positions_[i], *states[i].position).norm();
    const double velocity = correction_.at(velocity_.times()[i]).rate.norm();
    if (position > contradiction_.position) {
      contradiction_.position = position;
      contradiction_.position_at = i;
    }
    if (velocity > contradiction_.velocity) {
      contradiction_.velocity = velocity;
      contradiction_.velocity_at = i;
    }
  }
}

}  // namespace canhil::world
