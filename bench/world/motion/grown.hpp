// A motion that grows during the run, because commands steer what moves: a plant adds a point after each of
// its steps.
//
// Between two points, velocity and rotation vector are cubic polynomials of time, so acceleration and angular
// rate are continuous. They fit the derivatives at both points. The derivative at a point is that of the
// parabola through this point and the two before it, because no later point is known; its error is of second
// order in the step. At the first point the derivatives are zero.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/world/kinematics.hpp"
#include "dbc/spool/spool.hpp"

namespace canhil::world {

class GrownPath {
 public:
  struct Point {
    std::int64_t t_us = 0;
    Vector3 v_eb_n = Vector3::Zero();  ///< [m/s]
    Matrix3 C_bn = Matrix3::Identity();
  };

  /// `first`: the point at time 0.
  explicit GrownPath(const Point& first);
  /// Adds a point later than all others.
  void add(const Point& point);

  [[nodiscard]] std::int64_t end_us() const { return nodes_.back().t_us; }
  /// At a time [s] from 0 to the end. At a point: exactly the point.
  [[nodiscard]] Movement movement(double t) const;
  [[nodiscard]] Vector3 velocity(double t) const;
  /// Times of points between two times, ends excluded [us].
  [[nodiscard]] std::vector<std::int64_t> points_between(std::int64_t from_us, std::int64_t to_us) const;

 private:
  struct Node {
    std::int64_t t_us;
    Vector3 v_eb_n;       // [m/s]
    Vector3 v_eb_n_rate;  // [m/s^2]
    Matrix3 C_bn;
    Vector3 omega_nb_b;  // [rad/s]
    Vector3 turn;        // rotation vector from the node before, in the axes of that node [rad]
    Vector3 turn_rate;   // its derivative at this node [rad/s]
  };
  [[nodiscard]] std::size_t node_before(double t) const;

  Spool<Node> nodes_;
};

struct Grown {
  std::shared_ptr<const GrownPath> path;
};

inline Movement movement(const Grown& motion, double t) { return motion.path->movement(t); }
inline Vector3 velocity(const Grown& motion, double t) { return motion.path->velocity(t); }

}  // namespace canhil::world
