#pragma once
// Covariance of one plane in polar states x = [e, w, a] (error angle, LOS rate, target acceleration):
//   e' = w - q_n,   w' = (2 vc/r) w + (a - a_m)/r,   a' = white noise of PSD q,   vc = -r'
// and in displacement states y = [r e, r w - vc e, a], a chain of integrators for constant vc. The
// acceleration `a` has the sign of yaw; in pitch (z down), `a` is minus the acceleration along z (NOTES.md).

namespace canhil::los_rate {

/// A symmetric 3 x 3 matrix of the states (e, w, a), or (y1, y2, y3).
struct Covariance {
  double ee = 0, ew = 0, ea = 0, ww = 0, wa = 0, aa = 0;
};

/// Gain of the three states.
struct Gain {
  double e = 0, w = 0, a = 0;
};

/// Range [m] and closing speed [m/s] at a sample.
struct Geometry {
  double range = 0, closing_speed = 0;
};

/// The exact transition of x over a step dt that ends at `end`, for a constant closing speed:
/// Phi = [1 ew ea; 0 ww wa; 0 0 1]. The range at the start of the step is r0 = r + vc dt. In the rows of e
/// and w, the third column is multiplied by (a - a_m), so that a_m acts as the input.
struct Transition {
  double ew, ea, ww, wa;
};
/// The transition over dt [s] until `end`.
Transition transition(Geometry end, double dt);

/// Converts a covariance of y to one of x: M P M', M = [1/r 0 0; vc/r^2 1/r 0; 0 0 1].
Covariance polar(const Covariance& y, Geometry at);

/// P+ = Phi P Phi' + M Qd M', with M as in polar(). Qd is the effect on y of white jerk with the PSD
/// q [m^2/s^5] over dt [s].
Covariance predicted(const Covariance& P, Geometry end, double dt, double jerk_density);

/// K = P H'/S with S = P_ee + R, H = [1 0 0].
Gain kalman_gain(const Covariance& P, double R);

/// (I - K H) P for the optimal K.
Covariance updated(const Covariance& P, const Gain& K);

}  // namespace canhil::los_rate
