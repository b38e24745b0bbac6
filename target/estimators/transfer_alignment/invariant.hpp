#pragma once
// The feedback of an invariant error (Barrau, Bonnabel 2017, 'The invariant extended Kalman filter as a
// stable observer'). Attitude and velocity form one element of SE2(3). Its error is left-invariant, in the
// slave's body axes. The filter stores this error in the computed NED axes:
//   C = exp([phi x]) C_computed,  V = V_slave - J(phi) zeta,  J the left Jacobian of SO(3)
//   zeta' = (C f) x phi + C df,  y = V_slave - V_master = J(phi) zeta + v
// In body axes neither propagation nor gain depends on an estimate of C or V, so a heading error of any size
// does not change the observable directions.
#include <Eigen/Core>

#include "target/estimators/transfer_alignment/error_model.hpp"

namespace canhil::transfer_alignment {

/// The correction [12] for gain K [12 x 3] and innovation y [m/s, NED]; its velocity part is J(phi) zeta. The
/// correction is iterated once. This changes only the mean, not P, as the gain does not depend on the
/// estimate.
StateVector invariant_correction(const Eigen::Matrix<double, state_count, 3>& K, const Eigen::Vector3d& y);

/// Turns P [12 x 12] after a correction phi [rad, NED]. The error is constant in body axes but stored in
/// computed NED, which the correction changes. So P is turned from the axes before the correction into the
/// axes after it.
void turn_with_correction(Covariance& P, const Eigen::Vector3d& phi);

/// The initial tilt variances [rad^2] for stated attitude variances [rad^2, NED] s_t^2 (tilts) and s_D^2
/// (heading). For a tilt t, a P that is turned with the corrections contains the information 1/s_D^2 +
/// t't/s_t^2 about the heading. But the start provided only 1/s_D^2 + t't/(12 s_t^2). The excess is 11/6
/// rad^-2 on average. Increasing the tilt variances by the factor 1 + 40 s_D^2 keeps this excess below 5 % of
/// 1/s_D^2.
Eigen::Vector2d initial_tilt_variance(const Eigen::Vector3d& stated);

}  // namespace canhil::transfer_alignment
