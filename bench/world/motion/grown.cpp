#include "bench/world/motion/grown.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace canhil::world {
namespace {

// The rotation vector of a rotation by less than half a turn.
Vector3 rotation_vector(const Matrix3& C) {
  const Eigen::AngleAxisd turn(C);
  return turn.angle() * turn.axis();
}

// The matrix J with omega = J d(phi)/dt, where omega is in the rotated axes of exp([phi x]), Chirikjian
// (2012), eq. (10.86).
Matrix3 right_jacobian(const Vector3& phi) {
  const double angle = phi.norm();
  const Matrix3 S = skew(phi);
  constexpr double small = 1e-4;  // here the series are exact to rounding
  const double a = angle < small ? 0.5 - angle * angle / 24 : (1 - std::cos(angle)) / (angle * angle);
  const double b =
      angle < small ? 1.0 / 6 - angle * angle / 120 : (angle - std::sin(angle)) / (angle * angle * angle);
  return Matrix3::Identity() - a * S + b * S * S;
}

// A cubic polynomial over [0, h] with these values and derivatives at the ends.
struct Cubic {
  Vector3 from, from_rate, to, to_rate;
  double h;

  [[nodiscard]] Vector3 at(double s) const {
    const double u = s / h;
    return (1 + 2 * u) * (1 - u) * (1 - u) * from + u * (1 - u) * (1 - u) * h * from_rate +
           u * u * (3 - 2 * u) * to + u * u * (u - 1) * h * to_rate;
  }
  [[nodiscard]] Vector3 rate_at(double s) const {
    const double u = s / h;
    return 6 * u * (1 - u) / h * (to - from) + (1 - u) * (1 - 3 * u) * from_rate + u * (3 * u - 2) * to_rate;
  }
};

// The derivative, at the newest of three points, of the parabola through them; `before` and `last`: the
// differences of the values over the intervals h_before and h.
Vector3 newest_rate(const Vector3& before, double h_before, const Vector3& last, double h) {
  const Vector3 slope = last / h;
  return slope + h * (slope - before / h_before) / (h + h_before);
}

double seconds_of(std::int64_t t_us) { return 1e-6 * static_cast<double>(t_us); }

}  // namespace

GrownPath::GrownPath(const Point& first) {
  const Vector3 none = Vector3::Zero();
  nodes_.push_back({.t_us = first.t_us,
                    .v_eb_n = first.v_eb_n,
                    .v_eb_n_rate = none,
                    .C_bn = first.C_bn,
                    .omega_nb_b = none,
                    .turn = none,
                    .turn_rate = none});
}

void GrownPath::add(const Point& point) {
  const Node last = nodes_.back();
  const double h = seconds_of(point.t_us - last.t_us);
  const Vector3 gain = point.v_eb_n - last.v_eb_n;
  const Vector3 turn = rotation_vector(last.C_bn.transpose() * point.C_bn);
  Vector3 v_rate = gain / h, turn_rate = turn / h;
  if (nodes_.size() > 1) {
    const Node& earlier = nodes_[nodes_.size() - 2];
    const double h_before = seconds_of(last.t_us - earlier.t_us);
    v_rate = newest_rate(last.v_eb_n - earlier.v_eb_n, h_before, gain, h);
    turn_rate = newest_rate(last.turn, h_before, turn, h);
  }
  nodes_.push_back({.t_us = point.t_us,
                    .v_eb_n = point.v_eb_n,
                    .v_eb_n_rate = v_rate,
                    .C_bn = point.C_bn,
                    .omega_nb_b = right_jacobian(turn) * turn_rate,
                    .turn = turn,
                    .turn_rate = turn_rate});
}

std::size_t GrownPath::node_before(double t) const {
  const auto t_us = static_cast<std::int64_t>(std::floor(1e6 * t + 1e-3));  // t is rounded
  const auto after = std::ranges::upper_bound(nodes_, t_us, {}, &Node::t_us);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - nodes_.begin() - 1, 0));
}

Movement GrownPath::movement(double t) const {
  const std::size_t index = node_before(t);
  const Node& from = nodes_[index];
  const double s = t - seconds_of(from.t_us);
  if (index + 1 == nodes_.size() || s == 0)
    return {.v_eb_n = from.v_eb_n,
            .v_eb_n_rate = from.v_eb_n_rate,
            .C_bn = from.C_bn,
            .omega_nb_b = from.omega_nb_b};
  const Node& to = nodes_[index + 1];
  const double h = seconds_of(to.t_us - from.t_us);
  const Cubic v{from.v_eb_n, from.v_eb_n_rate, to.v_eb_n, to.v_eb_n_rate, h};
  const Cubic turn{Vector3::Zero(), from.omega_nb_b, to.turn, to.turn_rate, h};
  const Vector3 phi = turn.at(s);
  return {.v_eb_n = v.at(s),
          .v_eb_n_rate = v.rate_at(s),
          .C_bn = from.C_bn * rotation(phi),
          .omega_nb_b = right_jacobian(phi) * turn.rate_at(s)};
}

Vector3 GrownPath::velocity(double t) const {
  const std::size_t index = node_before(t);
  const Node& from = nodes_[index];
  const double s = t - seconds_of(from.t_us);
  if (index + 1 == nodes_.size()) return from.v_eb_n;
  const Node& to = nodes_[index + 1];
  return Cubic{from.v_eb_n, from.v_eb_n_rate, to.v_eb_n, to.v_eb_n_rate, seconds_of(to.t_us - from.t_us)}.at(
      s);
}

std::vector<std::int64_t> GrownPath::points_between(std::int64_t from_us, std::int64_t to_us) const {
  std::vector<std::int64_t> times;
  for (auto node = std::ranges::upper_bound(nodes_, from_us, {}, &Node::t_us);
       node != nodes_.end() && node->t_us < to_us; ++node)
    times.push_back(node->t_us);
  return times;
}

}  // namespace canhil::world
