#pragma once
// The 12 states and their equations (Park and Park 2019, eqs. (3)-(16), with the corrections in NOTES.md):
//   v_a'   = -omega x v_a + F/m + C_nb g - C_nb v_w'       air velocity, body [m/s]
//   omega' = I^-1 (M - omega x I omega)                    rates, body [rad/s]
//   Phi'   = E(Phi) omega                                  Euler angles roll, pitch, heading [rad]
//   v_w'   = noise                                         wind, NED [m/s]
//   y      = [C_bn v_a + v_w, omega, Phi]                  ground velocity, NED [m/s], rates, Euler angles
#include <Eigen/Core>
#include <optional>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/wind/aerodynamics.hpp"
#include "target/estimators/wind/design.hpp"

namespace canhil::wind {

using StateVector = filtering::Vector<12>;
using Covariance = filtering::Matrix<12, 12>;
using Observation = filtering::Vector<9>;

inline constexpr int air_velocity_at = 0;  ///< the first state of the air velocity
inline constexpr int rate_at = 3;          ///< the first state of the rates
inline constexpr int attitude_at = 6;      ///< the first state of the Euler angles
inline constexpr int wind_at = 9;          ///< the first state of the wind

/// Inputs that act during a step.
struct Inputs {
  Deflection fins;
  Air air;
};

/// x' without noise; sets flags in `outside` for quantities outside the model's range.
StateVector derivative(const StateVector& x, const Inputs& inputs, const Design& design, RangeFlags& outside);

/// d(derivative)/dx in 3 x 3 blocks; all other blocks are zero.
struct Jacobian {
  Eigen::Matrix3d aa, ao, ap;  // of v_a' with respect to v_a, omega, Phi
  Eigen::Matrix3d oa, oo;      // of omega'
  Eigen::Matrix3d po, pp;      // of Phi'
};

/// x' and its derivatives at one state.
struct Linearisation {
  StateVector f;
  Jacobian A;
  std::optional<LoadsByPart> loads;  // if the process noise depends on them
};

/// x' and its analytic Jacobian at x.
Linearisation linearise(const StateVector& x, const Inputs& inputs, const Design& design,
                        RangeFlags& outside);

/// x after dt by one Runge-Kutta step of fourth order; `f` is x' at the start of the step.
StateVector predicted(const StateVector& x, const StateVector& f, double dt, const Inputs& inputs,
                      const Design& design, RangeFlags& outside);

/// G = A dt + (A dt)^2/2, where Phi = I + G. Only 9 x 8 elements are stored. The rows of the wind are zero,
/// because the wind is constant; the columns of heading and wind are zero, because no derivative depends on
/// heading or wind.
using Growth = filtering::Matrix<9, 8>;
/// G for a step of dt [s].
Growth growth(const Jacobian& A, double dt);

/// Phi P Phi'; the caller adds Q.
Covariance predicted(const Covariance& P, const Growth& G);

/// Lasting errors: the relative error of each part of each coefficient (LoadsByPart), and the errors of
/// navigation's velocity (NED) and Euler angles.
inline constexpr int lasting_count = part_count + 6;
inline constexpr int velocity_bias_at = part_count;      ///< the first lasting error of the velocity
inline constexpr int attitude_bias_at = part_count + 3;  ///< the first lasting error of the Euler angles
using LastingErrors = Eigen::Matrix<double, 1, lasting_count>;
/// The 1-sigma values of the lasting errors that the settings state.
LastingErrors lasting_sigma(const Settings& settings);

/// Sensitivity of the states' errors to lasting errors: dx divided by each of them.
using Sensitivity = filtering::Matrix<12, lasting_count>;

/// S+ = Phi S + (I + Phi)/2 (dx'/de) dt, where e are the lasting errors; dx'/de follows from `loads`, and is
/// 0 for errors of navigation.
void predict(Sensitivity& S, const Growth& G, const LoadsByPart& loads, double dt, const Design& design);

/// C_bn v_a, C_bn and d(C_bn v_a)/dPhi.
struct GroundVelocity {
  Eigen::Vector3d C_v_a;
  Eigen::Matrix3d C_bn, by_attitude;
};
/// The ground velocity without wind, and its derivative.
GroundVelocity ground_velocity(const StateVector& x);

/// C_bn from the Euler angles roll, pitch, heading [rad].
Eigen::Matrix3d C_bn(const Eigen::Vector3d& attitude);

/// The angle in [-pi, pi].
double wrapped(double angle);

}  // namespace canhil::wind
