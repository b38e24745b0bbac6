#include "target/estimators/wind/aerodynamics.hpp"

#include <algorithm>
#include <cmath>

#include "target/estimators/wind/squared.hpp"

namespace canhil::wind {
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Eigen::Vector3d;

// Clamps `value` to the range; sets `outside` to whether the value was outside the range.
double held(double value, const Range& range, bool& outside) {
  outside = !(value >= range.least && value <= range.most);
  return std::clamp(value, range.least, range.most);
}

double drag_of(const Deflection& fins, const Drag& drag) {
  return drag.deflection_squared *
         (fins.elevator * fins.elevator + fins.aileron * fins.aileron + fins.rudder * fins.rudder);
}

// A coefficient's derivatives with respect to V, alpha and beta, and to the three reduced rates.
struct Slope {
  Vector3d flow = Vector3d::Zero(), rates = Vector3d::Zero();
};

}  // namespace

RangeFlags& RangeFlags::operator|=(const RangeFlags& other) {
  alpha |= other.alpha;
  beta |= other.beta;
  speed |= other.speed;
  mach |= other.mach;
  altitude |= other.altitude;
  pitch |= other.pitch;
  return *this;
}

Flow flow(const Vector3d& v_a, const Vector3d& omega, const Air& air, const Airframe& airframe) {
  Flow f;
  f.speed = held(v_a.norm(), airframe.speed, f.outside.speed);
  f.mach = f.speed / air.speed_of_sound;
  f.outside.mach = f.mach > airframe.mach_most;
  if (f.outside.mach) {
    f.mach = airframe.mach_most;
    f.speed = f.mach * air.speed_of_sound;
  }
  f.alpha = held(std::atan2(v_a.z(), v_a.x()), airframe.alpha, f.outside.alpha);
  // Equals asin(v/V); but in this form, rounding cannot make an argument larger than 1.
  f.beta = held(std::atan2(v_a.y(), std::hypot(v_a.x(), v_a.z())), airframe.beta, f.outside.beta);
  f.sin_alpha = std::sin(f.alpha);
  f.cos_alpha = std::cos(f.alpha);
  f.compressibility = 1 + airframe.mach_squared * f.mach * f.mach;
  f.rates = Vector3d(airframe.span, airframe.chord, airframe.span).cwiseProduct(omega) / (2 * f.speed);
  return f;
}

Coefficients coefficients(const Flow& f, const Deflection& fins, const Airframe& airframe) {
  const auto longitudinal = [&](const Longitudinal& t) {
    return f.compressibility * (t.constant + t.alpha * f.alpha + t.elevator * fins.elevator) +
           t.pitch_rate * f.rates.y();
  };
  const auto lateral = [&](const Lateral& t) {
    return f.compressibility * (t.sideslip * f.beta + t.aileron * fins.aileron + t.rudder * fins.rudder) +
           t.roll_rate * f.rates.x() + t.yaw_rate * f.rates.z();
  };
  const Drag& drag = airframe.drag;
  Coefficients c;
  c.lift = longitudinal(airframe.lift);
  c.drag = drag.constant + drag.lift_squared * c.lift * c.lift + drag.sideslip_squared * f.beta * f.beta +
           drag_of(fins, drag) + drag.wave * (1 + std::tanh((f.mach - drag.wave_mach) / drag.wave_width));
  c.side = lateral(airframe.side);
  c.roll = lateral(airframe.roll);
  c.pitch = longitudinal(airframe.pitch);
  c.yaw = lateral(airframe.yaw);
  return c;
}

Loads loads(const Flow& f, const Coefficients& c, const Air& air, const Airframe& airframe) {
  const double force = 0.5 * air.density * f.speed * f.speed * airframe.area;  // q-bar S [N]
  // fx = L sa - D ca, fy = Y, fz = -L ca - D sa
  return {(force / airframe.mass) * Vector3d(c.lift * f.sin_alpha - c.drag * f.cos_alpha, c.side,
                                             -c.lift * f.cos_alpha - c.drag * f.sin_alpha),
          force * Vector3d(airframe.span * c.roll, airframe.chord * c.pitch, airframe.span * c.yaw)};
}

LoadsByPart loads_by_part(const Flow& f, const Deflection& fins, const Coefficients& c, const Air& air,
                          const Airframe& airframe) {
  // Rate part: the coefficient minus its value at zero rates. Fin part: the value at zero rates minus the
  // value at zero rates and zero deflections.
  Flow steady = f;
  steady.rates.setZero();
  const Coefficients with_fins = coefficients(steady, fins, airframe);
  const Coefficients of_flow = coefficients(steady, {}, airframe);
  const auto parts = [&](double Coefficients::*which) {
    return RowVector3d(of_flow.*which, with_fins.*which - of_flow.*which, c.*which - with_fins.*which);
  };
  const double drag_of_fins = drag_of(fins, airframe.drag);
  const double force = 0.5 * air.density * f.speed * f.speed * airframe.area;
  const Vector3d along_lift(f.sin_alpha, 0, -f.cos_alpha), along_drag(-f.cos_alpha, 0, -f.sin_alpha);
  LoadsByPart by;
  by.specific_force << along_lift * parts(&Coefficients::lift),
      along_drag * RowVector3d(c.drag - drag_of_fins, drag_of_fins, 0),
      Vector3d::UnitY() * parts(&Coefficients::side);
  by.specific_force *= force / airframe.mass;
  by.moment << Vector3d::UnitX() * (airframe.span * parts(&Coefficients::roll)),
      Vector3d::UnitY() * (airframe.chord * parts(&Coefficients::pitch)),
      Vector3d::UnitZ() * (airframe.span * parts(&Coefficients::yaw));
  by.moment *= force;
  return by;
}

LoadsJacobian loads_jacobian(const Flow& f, const Coefficients& c, const Vector3d& v_a, const Air& air,
                             const Airframe& airframe) {
  const double V = f.speed, k = f.compressibility;
  const double k_V = 2 * airframe.mach_squared * f.mach / air.speed_of_sound;  // dk/dV
  // Relative derivatives with respect to V: k_V/k for the static and control part, -1/V for the rate part.
  const auto longitudinal = [&](const Longitudinal& t, double value) {
    const double rate_part = t.pitch_rate * f.rates.y();
    return Slope{{(value - rate_part) * k_V / k - rate_part / V, k * t.alpha, 0}, {0, t.pitch_rate, 0}};
  };
  const auto lateral = [&](const Lateral& t, double value) {
    const double rate_part = t.roll_rate * f.rates.x() + t.yaw_rate * f.rates.z();
    return Slope{{(value - rate_part) * k_V / k - rate_part / V, 0, k * t.sideslip},
                 {t.roll_rate, 0, t.yaw_rate}};
  };
  const Slope lift = longitudinal(airframe.lift, c.lift), pitch = longitudinal(airframe.pitch, c.pitch);
  const Slope side = lateral(airframe.side, c.side), roll = lateral(airframe.roll, c.roll),
              yaw = lateral(airframe.yaw, c.yaw);
  const Drag& t = airframe.drag;
  const double wave = std::tanh((f.mach - t.wave_mach) / t.wave_width);
  const double induced = 2 * t.lift_squared * c.lift;
  Slope drag{induced * lift.flow, induced * lift.rates};
  drag.flow.x() += t.wave * (1 - wave * wave) / (t.wave_width * air.speed_of_sound);
  drag.flow.z() += 2 * t.sideslip_squared * f.beta;

  // Derivatives with respect to V, alpha, beta (columns). The rows of force_flow are the force coefficients
  // along body x, y, z; the rows of moment_flow are b Cl, c Cm and b Cn.
  const double sa = f.sin_alpha, ca = f.cos_alpha, b = airframe.span;
  Matrix3d force_flow, force_rates, moment_flow, moment_rates;
  force_flow << sa * lift.flow.transpose() - ca * drag.flow.transpose(), side.flow.transpose(),
      -ca * lift.flow.transpose() - sa * drag.flow.transpose();
  force_flow(0, 1) += c.lift * ca + c.drag * sa;  // stability axes turn with alpha
  force_flow(2, 1) += c.lift * sa - c.drag * ca;
  force_rates << sa * lift.rates.transpose() - ca * drag.rates.transpose(), side.rates.transpose(),
      -ca * lift.rates.transpose() - sa * drag.rates.transpose();
  moment_flow << b * roll.flow.transpose(), airframe.chord * pitch.flow.transpose(), b * yaw.flow.transpose();
  moment_rates << b * roll.rates.transpose(), airframe.chord * pitch.rates.transpose(),
      b * yaw.rates.transpose();
  // The dynamic pressure: d(V^2 C)/dV = V^2 (C_V + 2 C/V).
  force_flow.col(0) += (2 / V) * Vector3d(c.lift * sa - c.drag * ca, c.side, -c.lift * ca - c.drag * sa);
  moment_flow.col(0) += (2 / V) * Vector3d(b * c.roll, airframe.chord * c.pitch, b * c.yaw);

  // Derivatives of V, alpha, beta with respect to u, v, w. They are zero for a clamped quantity. The lower
  // limit of 0.1 m/s keeps the derivatives finite at speeds far below the model's range.
  const double s = std::max(std::hypot(v_a.x(), v_a.z()), 0.1), V_true = std::max(v_a.norm(), 0.1);
  Matrix3d flow_v_a = Matrix3d::Zero();
  if (!f.outside.speed && !f.outside.mach) flow_v_a.row(0) = v_a.transpose() / V_true;
  if (!f.outside.alpha) flow_v_a.row(1) << -v_a.z() / (s * s), 0, v_a.x() / (s * s);
  if (!f.outside.beta) {
    const double squeeze = v_a.y() / (s * V_true * V_true);
    flow_v_a.row(2) << -v_a.x() * squeeze, s / (V_true * V_true), -v_a.z() * squeeze;
  }
  const double force = 0.5 * air.density * V * V * airframe.area;
  const Vector3d reduced = Vector3d(airframe.span, airframe.chord, airframe.span) / (2 * V);
  LoadsJacobian J;
  J.force_v_a = (force / airframe.mass) * force_flow.lazyProduct(flow_v_a);
  J.force_omega = (force / airframe.mass) * force_rates * reduced.asDiagonal();
  J.moment_v_a = force * moment_flow.lazyProduct(flow_v_a);
  J.moment_omega = force * moment_rates * reduced.asDiagonal();
  return J;
}

}  // namespace canhil::wind
