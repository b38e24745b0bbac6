#include "bench/world/flight_record.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cassert>

#include "bench/world/stoppable.hpp"

namespace canhil::world {
namespace {

double seconds(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

/// Rate and specific force at one instant.
struct Rates {
  Vector3 omega_ib_b;
  Vector3 f_ib_b;
};

Rates rates_of(const Movement& now, const Position& position) {
  const Matrix3& C_bn = now.C_bn;
  const Vector3 omega_ie = omega_ie_n(position.latitude);
  const Vector3 omega_en = omega_en_n(position, now.v_eb_n);
  const Vector3 f_ib_n =
      now.v_eb_n_rate + (2.0 * omega_ie + omega_en).cross(now.v_eb_n) - gravity_n(position);
  return {.omega_ib_b = now.omega_nb_b + C_bn.transpose() * (omega_ie + omega_en),
          .f_ib_b = C_bn.transpose() * f_ib_n};
}

Position advanced(const Motion& motion, const Position& position, double t, double dt) {
  return advanced(position, velocity(motion, t), velocity(motion, t + 0.5 * dt), velocity(motion, t + dt),
                  dt);
}

Truth truth_of(const Motion& motion, const Position& position, std::int64_t t_us) {
  const Movement now = movement(motion, seconds(t_us));
  const Rates rates = rates_of(now, position);
  return {.t_us = t_us,
          .position = position,
          .v_eb_n = now.v_eb_n,
          .C_bn = now.C_bn,
          .omega_ib_b = rates.omega_ib_b,
          .f_ib_b = rates.f_ib_b};
}

struct Node {
  double at;      ///< fraction of the interval
  double weight;  ///< the weights add up to 1
};

// The rule has five nodes, so it is exact for polynomials up to degree 9. Over an interval of 10 ms, the
// relative error for a sinusoid of 20 Hz (a phase of 1.3 rad) is 1e-11, and for a sinusoid of 5 Hz it is
// 1e-17.
std::array<Node, 5> gauss_legendre() {
  using Rule = boost::math::quadrature::gauss<double, 5>;
  const auto& x = Rule::abscissa();  // nodes on [-1, 1]: only those >= 0, ascending
  const auto& w = Rule::weights();
  const auto node = [&](std::size_t i, double sign) {
    return Node{.at = 0.5 * (1.0 + sign * x[i]), .weight = 0.5 * w[i]};
  };
  return {node(2, -1), node(1, -1), node(0, 1), node(1, 1), node(2, 1)};
}

/// Divides an interval at the jumps of the motion, and calls piece(from, to) for each part.
template <class Piece>
void between_jumps(const Motion& motion, std::int64_t from_us, std::int64_t to_us, Piece piece) {
  for (const std::int64_t jump : jumps_us(motion, from_us, to_us)) {
    piece(from_us, jump);
    from_us = jump;
  }
  piece(from_us, to_us);
}

/// Adds the integrals over the interval from a to b to `sum`, and advances the position to b. The interval
/// must not contain a jump of the motion.
void integrate(const Motion& motion, std::int64_t a_us, std::int64_t b_us, Position& position,
               ImuIncrement& sum) {
  static const std::array<Node, 5> nodes = gauss_legendre();
  const double length = seconds(b_us - a_us);
  double t = seconds(a_us);
  for (const Node& node : nodes) {
    const double t_node = seconds(a_us) + node.at * length;
    position = advanced(motion, position, t, t_node - t);
    t = t_node;
    const Rates rates = rates_of(movement(motion, t), position);
    sum.delta_theta += node.weight * length * rates.omega_ib_b;
    sum.delta_v += node.weight * length * rates.f_ib_b;
  }
  position = advanced(motion, position, t, seconds(b_us) - t);
}

}  // namespace

FlightRecord::FlightRecord(const Flight& flight, std::int64_t duration_us, std::int64_t interval_us)
    : flight_(flight),
      interval_us_(interval_us),
      end_us_(duration_us / interval_us * interval_us),
      position_(flight.start) {
  assert(duration_us >= 0 && interval_us > 0);
  const auto count = static_cast<std::size_t>(duration_us / interval_us);
  epochs_.reserve(count + 1);
  increments_.reserve(count);
  epochs_.push_back(truth_of(flight.motion, position_, 0));
  if (!grows()) fly_to(end_us_);
  if (!grows()) end_us_ = epochs_.back().t_us;  // the flight may have been stopped
}

void FlightRecord::fly_to(std::int64_t end_us) {
  const Motion& motion = flight_.motion;
  // What has grown is complete also after a signal, because the run's next transmission looks at it.
  const auto stopped = [&] { return !grows() && Stoppable::stopped(); };
  for (std::int64_t end = epochs_.back().t_us + interval_us_; end <= end_us && !stopped();
       end += interval_us_) {
    ImuIncrement increment{.t_us = end, .interval_us = interval_us_};
    between_jumps(motion, end - interval_us_, end, [&](std::int64_t a_us, std::int64_t b_us) {
      integrate(motion, a_us, b_us, position_, increment);
    });
    increments_.push_back(increment);
    epochs_.push_back(truth_of(motion, position_, end));
  }
}

void FlightRecord::follow() {
  const auto* grown = std::get_if<Grown>(&flight_.motion);
  if (grown != nullptr) fly_to(std::min(end_us_, grown->path->end_us()));
}

std::int64_t FlightRecord::known_until_us() const {
  const auto* grown = std::get_if<Grown>(&flight_.motion);
  return grown == nullptr ? end_us_ : std::min(end_us_, grown->path->end_us());
}

Truth FlightRecord::at(std::int64_t t_us) const {
  assert(t_us >= 0 && t_us <= known_until_us());
  const Truth& before = epochs_[static_cast<std::size_t>(t_us / interval_us_)];
  if (before.t_us == t_us) return before;
  Position position = before.position;
  between_jumps(flight_.motion, before.t_us, t_us, [&](std::int64_t a_us, std::int64_t b_us) {
    position = advanced(flight_.motion, position, seconds(a_us), seconds(b_us - a_us));
  });
  return truth_of(flight_.motion, position, t_us);
}

}  // namespace canhil::world
