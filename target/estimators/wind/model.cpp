#include "target/estimators/wind/model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "target/estimators/filtering/block_transition.hpp"
#include "target/estimators/strapdown/attitude.hpp"

namespace canhil::wind {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using strapdown::skew;

// Sines and cosines of roll and pitch. The kinematics have a pole at a pitch of 90 deg, so for them the pitch
// is clamped below 90 deg.
struct Tilt {
  double sin_roll, cos_roll, sin_pitch, cos_pitch;
  double tan_pitch, sec_pitch;
  bool held;
};

Tilt tilt_of(const StateVector& x, const Airframe& airframe, RangeFlags& outside) {
  const double roll = x(attitude_at), pitch = x(attitude_at + 1);
  Tilt t{std::sin(roll), std::cos(roll), std::sin(pitch), std::cos(pitch), 0, 0, false};
  t.held = !(std::abs(pitch) <= airframe.pitch_most);
  if (t.held) {
    outside.pitch = true;
    t.sec_pitch = 1 / std::cos(airframe.pitch_most);
    t.tan_pitch = std::copysign(std::tan(airframe.pitch_most), pitch);
  } else {
    t.sec_pitch = 1 / t.cos_pitch;
    t.tan_pitch = t.sin_pitch * t.sec_pitch;
  }
  return t;
}

struct Evaluation {
  Vector3d v_a, omega;
  Flow flow;
  Coefficients c;
  Tilt tilt;
};

Evaluation evaluate(const StateVector& x, const Inputs& inputs, const Design& design, RangeFlags& outside) {
  const Vector3d v_a = x.segment<3>(air_velocity_at), omega = x.segment<3>(rate_at);
  const Flow f = flow(v_a, omega, inputs.air, design.airframe);
  outside |= f.outside;
  return {v_a, omega, f, coefficients(f, inputs.fins, design.airframe), tilt_of(x, design.airframe, outside)};
}

StateVector derivative(const Evaluation& e, const Inputs& inputs, const Design& design) {
  const Loads load = loads(e.flow, e.c, inputs.air, design.airframe);
  const Tilt& t = e.tilt;
  const Vector3d gravity_b =
      gravity * Vector3d(-t.sin_pitch, t.sin_roll * t.cos_pitch, t.cos_roll * t.cos_pitch);
  const double turn = t.sin_roll * e.omega.y() + t.cos_roll * e.omega.z();
  const Vector3d momentum = design.inertia * e.omega;
  StateVector f;
  f.segment<3>(air_velocity_at) = load.specific_force + gravity_b - e.omega.cross(e.v_a);
  f.segment<3>(rate_at) = design.inertia_inverse * (load.moment - e.omega.cross(momentum));
  f.segment<3>(attitude_at) << e.omega.x() + t.tan_pitch * turn,
      t.cos_roll * e.omega.y() - t.sin_roll * e.omega.z(), t.sec_pitch * turn;
  f.segment<3>(wind_at).setZero();
  return f;
}

Jacobian jacobian(const Evaluation& e, const Inputs& inputs, const Design& design) {
  const LoadsJacobian load = loads_jacobian(e.flow, e.c, e.v_a, inputs.air, design.airframe);
  const Tilt& t = e.tilt;
  const double q = e.omega.y(), r = e.omega.z();
  const double turn = t.sin_roll * q + t.cos_roll * r, sway = t.cos_roll * q - t.sin_roll * r;
  const double by_pitch = t.held ? 0 : t.sec_pitch;  // tan' = sec^2, sec' = sec tan
  const Vector3d momentum = design.inertia * e.omega;
  Jacobian A;
  A.aa = load.force_v_a - skew(e.omega);
  A.ao = load.force_omega + skew(e.v_a);
  A.ap << 0, -t.cos_pitch, 0,                                  //
      t.cos_roll * t.cos_pitch, -t.sin_roll * t.sin_pitch, 0,  //
      -t.sin_roll * t.cos_pitch, -t.cos_roll * t.sin_pitch, 0;
  A.ap *= gravity;
  A.oa = design.inertia_inverse * load.moment_v_a;
  A.oo = design.inertia_inverse * (load.moment_omega + skew(momentum) - skew(e.omega) * design.inertia);
  A.po << 1, t.tan_pitch * t.sin_roll, t.tan_pitch * t.cos_roll,  //
      0, t.cos_roll, -t.sin_roll,                                 //
      0, t.sec_pitch * t.sin_roll, t.sec_pitch * t.cos_roll;
  A.pp << t.tan_pitch * sway, by_pitch * t.sec_pitch * turn, 0,  //
      -turn, 0, 0,                                               //
      t.sec_pitch * sway, by_pitch * t.tan_pitch * turn, 0;
  return A;
}

}  // namespace

StateVector derivative(const StateVector& x, const Inputs& inputs, const Design& design,
                       RangeFlags& outside) {
  return derivative(evaluate(x, inputs, design, outside), inputs, design);
}

Linearisation linearise(const StateVector& x, const Inputs& inputs, const Design& design,
                        RangeFlags& outside) {
  const Evaluation e = evaluate(x, inputs, design, outside);
  Linearisation at{derivative(e, inputs, design), jacobian(e, inputs, design), std::nullopt};
  if (follows_loads(design.settings.process_noise))
    at.loads = loads_by_part(e.flow, inputs.fins, e.c, inputs.air, design.airframe);
  return at;
}

StateVector predicted(const StateVector& x, const StateVector& f, double dt, const Inputs& inputs,
                      const Design& design, RangeFlags& outside) {
  const StateVector k2 = derivative(x + (dt / 2) * f, inputs, design, outside);
  const StateVector k3 = derivative(x + (dt / 2) * k2, inputs, design, outside);
  const StateVector k4 = derivative(x + dt * k3, inputs, design, outside);
  return x + (dt / 6) * (f + 2 * (k2 + k3) + k4);
}

Growth growth(const Jacobian& A, double dt) {
  const double half = dt * dt / 2;
  filtering::Matrix<9, 9> G;
  const auto block = [&](Eigen::Index row, Eigen::Index column) {
    return G.block<3, 3>(3 * row, 3 * column);
  };
  block(0, 0) = dt * A.aa + half * (A.aa.lazyProduct(A.aa) + A.ao.lazyProduct(A.oa));
  block(0, 1) = dt * A.ao + half * (A.aa.lazyProduct(A.ao) + A.ao.lazyProduct(A.oo) + A.ap.lazyProduct(A.po));
  block(0, 2) = dt * A.ap + half * (A.aa.lazyProduct(A.ap) + A.ap.lazyProduct(A.pp));
  block(1, 0) = dt * A.oa + half * (A.oa.lazyProduct(A.aa) + A.oo.lazyProduct(A.oa));
  block(1, 1) = dt * A.oo + half * (A.oa.lazyProduct(A.ao) + A.oo.lazyProduct(A.oo));
  block(1, 2) = half * A.oa.lazyProduct(A.ap);
  block(2, 0) = half * A.po.lazyProduct(A.oa);
  block(2, 1) = dt * A.po + half * (A.po.lazyProduct(A.oo) + A.pp.lazyProduct(A.po));
  block(2, 2) = dt * A.pp + half * A.pp.lazyProduct(A.pp);
  return G.leftCols<8>();
}

Covariance predicted(const Covariance& P, const Growth& G) {
  return filtering::propagate_covariance_moving<9>(
      P, [&G](const auto& M) { return M.template leftCols<8>().lazyProduct(G.transpose()); });
}

LastingErrors lasting_sigma(const Settings& settings) {
  LastingErrors sigma;
  sigma.head<part_count>().setConstant(settings.coefficient_sigma);
  sigma.segment<3>(velocity_bias_at).setConstant(settings.velocity_bias_sigma);
  sigma.segment<3>(attitude_bias_at).setConstant(settings.attitude_bias_sigma);
  return sigma;
}

void predict(Sensitivity& S, const Growth& G, const LoadsByPart& loads, double dt, const Design& design) {
  const auto add_half = [&] {
    S.block<3, force_part_count>(air_velocity_at, 0) += (dt / 2) * loads.specific_force;
    S.block<3, part_count - force_part_count>(rate_at, force_part_count) +=
        ((dt / 2) * design.inertia_inverse).lazyProduct(loads.moment);
  };
  add_half();
  const filtering::Matrix<9, lasting_count> grown = G.lazyProduct(S.topRows<8>());
  S.topRows<9>() += grown;
  add_half();
}

Matrix3d C_bn(const Vector3d& attitude) {
  const double sr = std::sin(attitude.x()), cr = std::cos(attitude.x());
  const double sp = std::sin(attitude.y()), cp = std::cos(attitude.y());
  const double sh = std::sin(attitude.z()), ch = std::cos(attitude.z());
  Matrix3d C;
  C << cp * ch, sr * sp * ch - cr * sh, cr * sp * ch + sr * sh,  //
      cp * sh, sr * sp * sh + cr * ch, cr * sp * sh - sr * ch,   //
      -sp, sr * cp, cr * cp;
  return C;
}

GroundVelocity ground_velocity(const StateVector& x) {
  GroundVelocity g;
  const Vector3d v_a = x.segment<3>(air_velocity_at);
  g.C_bn = C_bn(x.segment<3>(attitude_at));
  g.C_v_a = g.C_bn * v_a;
  // C_bn = Rz(heading) Ry(pitch) Rx(roll): each angle turns C_bn v_a about its own axis.
  const double heading = x(attitude_at + 2);
  const Vector3d pitch_axis(-std::sin(heading), std::cos(heading), 0);
  g.by_attitude.col(0) = g.C_bn.col(0).cross(g.C_v_a);
  g.by_attitude.col(1) = pitch_axis.cross(g.C_v_a);
  g.by_attitude.col(2) = Vector3d(-g.C_v_a.y(), g.C_v_a.x(), 0);
  return g;
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace canhil::wind
