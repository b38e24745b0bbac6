#pragma once
// The feedback of an invariant error (Barrau, Bonnabel 2017, 'The invariant extended Kalman filter as a
// stable observer'): attitude and velocity as one element of SE2(3), its left-invariant error in the slave's
// body axes, here kept turned into computed NED:
//   C = exp([phi x]) C_computed,  V = V_slave - J(phi) zeta,  J the left Jacobian of SO(3)
//   zeta' = (C f) x phi + C df,  y = V_slave - V_master = J(phi) zeta + v
// In body axes neither the propagation nor the gain asks for an estimate of C or V, so a heading error of any
// size leaves the directions of what is known alone.
#include <Eigen/Core>

#include "target/estimators/transfer_alignment/error_model.hpp"

namespace canhil::transfer_alignment {

/// The correction [12] of gain K [12 x 3] for innovation y [m/s, NED], its velocity part J(phi) zeta: the
/// gain is the same at every estimate, so one iteration moves the mean alone.
StateVector invariant_correction(const Eigen::Matrix<double, state_count, 3>& K, const Eigen::Vector3d& y);

/// P [12 x 12] of an error in body axes, from the NED axes before a correction phi [rad, NED] into those
/// after it.
void turn_with_correction(Covariance& P, const Eigen::Vector3d& phi);

/// The variances of the tilts [rad^2] at the start for the variances of the attitude [rad^2, NED] as told,
/// s_t^2 and s_D^2. Turned with the corrections, P tells of a heading about the true vertical that was seen
/// at a tilt t 1/s_D^2 + t't/s_t^2, where the start told 1/s_D^2 + t't/(12 s_t^2): 11/6 /rad^2 too much in
/// the mean. Tilts wider by 1 + 40 s_D^2 keep that below 5 % of the first.
Eigen::Vector2d initial_tilt_variance(const Eigen::Vector3d& told);

}  // namespace canhil::transfer_alignment
