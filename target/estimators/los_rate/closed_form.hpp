#pragma once
// Steady states of the filter's Riccati equation in closed form, and their discrete gains. In displacement
// states y the plant is a chain of integrators and the measurement noise R_y(t) = r^2 R(r): thermal noise
// makes it r^6, glint makes it constant. With nu = -(1/6) d ln R_y/dt the equation becomes algebraic.
#include "target/estimators/los_rate/covariance.hpp"
#include "target/estimators/los_rate/settings.hpp"

namespace canhil::los_rate {

/// Variance of one sample of an error angle at range r [m]: thermal^2 r^4 + glint^2/r^2 + constant^2
/// [rad^2] (Na and Lee, eq. (3), which has no constant term).
double sample_variance(const Noise& noise, double range);

/// P-bar of 0 = A P + P A' - P C'C P/s2 + q B B' with A = [3v/2 1 0; 0 5v/2 1; 0 0 v/2], B = [0 0 1]',
/// C = [1 0 0]: the stabilising solution (Na and Lee, eqs. (6)-(8), for the sign of yaw). v >= 0, q >= 0,
/// s2 > 0. v = vc and s2 = thermal^2 Ts give the paper's thermal table; v = 0 and s2 = glint^2 Ts its glint.
Covariance riccati(double q, double s2, double v);

/// The noise of a displacement, as a PSD R_y [m^2 s], and its rate nu [1/s].
struct DisplacementNoise {
  double R_y, nu;
};
/// Of thermal, glint and constant noise together at `at`, a sample every Ts [s].
DisplacementNoise displacement_noise(const Noise& noise, Geometry at, double Ts);

/// The steady state of noise (R_y, nu): covariance of y, and the continuous gain d = P_y(1,:)/R_y. Exact for
/// thermal noise alone and for glint alone where vc is constant; an approximation for their sum.
struct SteadyState {
  Covariance P;
  Gain d;
};
SteadyState steady_state(double q, DisplacementNoise noise);

/// K = [d1, d2 + (vc/r) d1, r d3]: a gain of y as a gain of x, which the error angle drives.
Gain polar(const Gain& d, Geometry at);
/// The inverse.
Gain displacement(const Gain& K, Geometry at);

/// Discrete gain of y a sample every Ts [s] whose error poles are exp(s Ts) of the poles s of the continuous
/// gain d, s^3 + d1 s^2 + d2 s + d3 = 0: [alpha, beta/Ts, gamma/Ts^2]. Stable for any Ts. d Hurwitz.
Gain pole_matched(const Gain& d, double Ts);

/// Range [m] where thermal and glint noise are equal: thermal above, glint below.
double crossing_range(const Noise& noise);

}  // namespace canhil::los_rate
