#include "target/estimators/los_rate/covariance.hpp"

namespace canhil::los_rate {

Transition transition(Geometry end, double dt) {
  const double r = end.range, r0 = r + end.closing_speed * dt;
  const double ratio = r0 / r;
  return {dt * ratio, dt * dt / (2 * r), ratio * ratio, dt * (r0 + r) / (2 * r * r)};
}

Covariance polar(const Covariance& y, Geometry at) {
  const double u = 1 / at.range, s = at.closing_speed * u;  // e = u y1, w = u (y2 + s y1)
  const double ee = u * u * y.ee, e2 = u * u * y.ew;
  return {.ee = ee,
          .ew = e2 + s * ee,
          .ea = u * y.ea,
          .ww = u * u * y.ww + s * (2 * e2 + s * ee),
          .wa = u * (y.wa + s * y.ea),
          .aa = y.aa};
}

Covariance predicted(const Covariance& P, Geometry end, double dt, double jerk_density) {
  const Transition phi = transition(end, dt);
  // X = Phi P, then P+ = X Phi'.
  const double ee = P.ee + phi.ew * P.ew + phi.ea * P.ea;
  const double ew = P.ew + phi.ew * P.ww + phi.ea * P.wa;
  const double ea = P.ea + phi.ew * P.wa + phi.ea * P.aa;
  const double ww = phi.ww * P.ww + phi.wa * P.wa;
  const double wa = phi.ww * P.wa + phi.wa * P.aa;
  const double q1 = jerk_density * dt, q2 = q1 * dt, q3 = q2 * dt;
  const Covariance Q = polar(
      {.ee = q3 * dt * dt / 20, .ew = q3 * dt / 8, .ea = q3 / 6, .ww = q3 / 3, .wa = q2 / 2, .aa = q1}, end);
  return {.ee = ee + phi.ew * ew + phi.ea * ea + Q.ee,
          .ew = phi.ww * ew + phi.wa * ea + Q.ew,
          .ea = ea + Q.ea,
          .ww = phi.ww * ww + phi.wa * wa + Q.ww,
          .wa = wa + Q.wa,
          .aa = P.aa + Q.aa};
}

Gain kalman_gain(const Covariance& P, double R) {
  const double inverse_S = 1 / (P.ee + R);
  return {P.ee * inverse_S, P.ew * inverse_S, P.ea * inverse_S};
}

Covariance updated(const Covariance& P, const Gain& K) {
  return {.ee = (1 - K.e) * P.ee,
          .ew = (1 - K.e) * P.ew,
          .ea = (1 - K.e) * P.ea,
          .ww = P.ww - K.w * P.ew,
          .wa = P.wa - K.w * P.ea,
          .aa = P.aa - K.a * P.ea};
}

}  // namespace canhil::los_rate
