#pragma once
// Steady states of the filter's Riccati equation in closed form, and their discrete gains. In displacement
// states y the plant is a chain of integrators. The PSD of its measurement noise is R_y(t) = r^2 R(r) Ts,
// which is proportional to r^6 for thermal noise and constant for glint. With nu = -(1/6) d ln R_y/dt the
// Riccati equation becomes algebraic.
#include "target/estimators/los_rate/covariance.hpp"
#include "target/estimators/los_rate/settings.hpp"

namespace canhil::los_rate {

/// Variance of one sample of an error angle at range r [m]: thermal^2 r^4 + glint^2/r^2 + constant^2
/// [rad^2] (Na and Lee, eq. (3), which has no constant term).
double sample_variance(const Noise& noise, double range);

/// P-bar, the stabilising solution P of 0 = A P + P A' - P C'C P/s2 + q B B' with
/// A = [3v/2 1 0; 0 5v/2 1; 0 0 v/2], B = [0 0 1]', C = [1 0 0] (Na and Lee, eqs. (6)-(8), for the sign of
/// yaw). Requires v >= 0, q >= 0 and s2 > 0. The paper's table for thermal noise has v = vc and s2 =
/// thermal^2 Ts; its table for glint has v = 0 and s2 = glint^2 Ts.
Covariance riccati(double q, double s2, double v);

/// The noise of the displacement: its PSD R_y [m^2 s] and the rate nu [1/s].
struct DisplacementNoise {
  double R_y, nu;
};
/// The sum of thermal, glint and constant noise for the geometry `at`, with a sample every Ts [s].
DisplacementNoise displacement_noise(const Noise& noise, Geometry at, double Ts);

/// The steady state for noise (R_y, nu): the covariance P_y of y, and the continuous gain d = P_y(1,:)/R_y.
/// If vc is constant, it is exact for thermal noise alone and for glint alone; for the sum of both it is an
/// approximation.
struct SteadyState {
  Covariance P;
  Gain d;
};
/// The steady state for jerk of PSD q [m^2/s^5].
SteadyState steady_state(double q, DisplacementNoise noise);

/// Converts a gain d for y to the gain K = [d1, d2 + (vc/r) d1, r d3] for x. K multiplies the innovation of
/// the error angle.
Gain polar(const Gain& d, Geometry at);
/// The inverse of polar().
Gain displacement(const Gain& K, Geometry at);

/// The discrete gain [alpha, beta/Ts, gamma/Ts^2] for y at the sample period Ts [s]. Its error poles are
/// exp(s Ts), where s are the poles of the continuous gain d: s^3 + d1 s^2 + d2 s + d3 = 0. Stable for any Ts
/// if d is Hurwitz.
Gain pole_matched(const Gain& d, double Ts);

/// Range [m] at which thermal and glint noise are equal: thermal dominates above, glint below.
double crossing_range(const Noise& noise);

}  // namespace canhil::los_rate
