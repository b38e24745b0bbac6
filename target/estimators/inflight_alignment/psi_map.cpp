#include "target/estimators/inflight_alignment/psi_map.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace canhil::inflight_alignment {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using At = Layout<15>;

Trig sum(const Trig& a, const Trig& b) {
  return {a.sin.cwiseProduct(b.cos) + a.cos.cwiseProduct(b.sin),
          a.cos.cwiseProduct(b.cos) - a.sin.cwiseProduct(b.sin)};
}
Trig difference(const Trig& a, const Trig& b) {
  return {a.sin.cwiseProduct(b.cos) - a.cos.cwiseProduct(b.sin),
          a.cos.cwiseProduct(b.cos) + a.sin.cwiseProduct(b.sin)};
}

// E(psi) times `rate`: how fast the Euler angles psi of Rz Ry Rx change if the rotation rate in p is `rate`.
Vector3d euler_rates(const Trig& t, const Vector3d& rate) {
  const double across = (t.sin.x() * rate.y() + t.cos.x() * rate.z()) / t.cos.y();
  return {rate.x() + across * t.sin.y(), t.cos.x() * rate.y() - t.sin.x() * rate.z(), across};
}

Matrix3d euler_rate_matrix(const Trig& t) {
  Matrix3d E;
  E << euler_rates(t, Vector3d::UnitX()), euler_rates(t, Vector3d::UnitY()),
      euler_rates(t, Vector3d::UnitZ());
  return E;
}

}  // namespace

Trig::Trig(const Vector3d& psi)
    : sin(std::sin(psi.x()), std::sin(psi.y()), std::sin(psi.z())),
      cos(std::cos(psi.x()), std::cos(psi.y()), std::cos(psi.z())) {}

Matrix3d rotation(const Trig& t) {
  const double sx = t.sin.x(), sy = t.sin.y(), sz = t.sin.z();
  const double cx = t.cos.x(), cy = t.cos.y(), cz = t.cos.z();
  Matrix3d C;
  C << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
      sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,   //
      -sy, cy * sx, cy * cx;
  return C;
}

PsiMap::PsiMap(const Vector<15>& x, const Interval& interval)
    : interval_(interval),
      wT_((interval.omega_ie_n + interval.omega_en_n) * interval.duration),
      trig_(Vector3d(x.segment<3>(At::attitude))),
      true_force_(interval.delta_v_n - interval.C_bn_integral * x.segment<3>(At::accel_bias)),
      drift_(interval.C_bn_integral * x.segment<3>(At::gyro_bias)),
      terms_(terms(trig_, true_force_, drift_)),
      coriolis_(2 * interval.omega_ie_n + interval.omega_en_n) {}

Terms PsiMap::terms(const Trig& t, const Vector3d& true_force, const Vector3d& drift) const {
  const Matrix3d C = rotation(t);
  return {C * true_force, euler_rates(t, wT_ - C.transpose() * wT_ - drift)};
}

Matrix3d PsiMap::velocity_accel() const { return rotation(trig_) * interval_.C_bn_integral; }

Matrix3d PsiMap::attitude_gyro() const { return -euler_rate_matrix(trig_) * interval_.C_bn_integral; }

filtering::Parts<9> PsiMap::parts(const Vector<15>& d) const {
  const Interval& interval = interval_;
  const double T = interval.duration;
  const Vector3d R = d.segment<3>(At::position), V = d.segment<3>(At::velocity);
  const Vector3d psi = d.segment<3>(At::attitude);
  const Vector3d force = interval.C_bn_integral * d.segment<3>(At::accel_bias);
  const Vector3d drift = interval.C_bn_integral * d.segment<3>(At::gyro_bias);
  const Trig turn(psi);
  const Terms plus = terms(sum(trig_, turn), true_force_ - force, drift_ + drift);
  const Terms minus = terms(difference(trig_, turn), true_force_ + force, drift_ - drift);

  const Vector3d odd_dV =
      T * (gravity_error_per_m().cwiseProduct(R) - coriolis_.cross(V)) - 0.5 * (plus.force - minus.force);
  const Vector3d even_dV = terms_.force - 0.5 * (plus.force + minus.force);
  filtering::Parts<9> parts;
  parts.odd.segment<3>(At::position) = R + T * (V + 0.5 * odd_dV - interval.omega_en_n.cross(R));
  parts.odd.segment<3>(At::velocity) = V + odd_dV;
  parts.odd.segment<3>(At::attitude) = psi + 0.5 * (plus.rates - minus.rates);
  parts.even.segment<3>(At::position) = (0.5 * T) * even_dV;
  parts.even.segment<3>(At::velocity) = even_dV;
  parts.even.segment<3>(At::attitude) = 0.5 * (plus.rates + minus.rates) - terms_.rates;
  return parts;
}

}  // namespace canhil::inflight_alignment
