#pragma once
// Sensor errors that the filter considers but does not estimate (Schmidt 1966, 'Application of State-Space
// Methods to Navigation Problems'): their sizes are known from data sheets, and the flight reveals little of
// them. Each is a number q with the variance 1 that stays as it is, except that the master's correlated error
// changes with time. The filter carries the covariance S of its states with q, so its gain and its sigmas
// allow for these errors.
#include <Eigen/Core>

#include "target/estimators/filtering/kalman.hpp"
#include "target/estimators/transfer_alignment/error_model.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

/// The index of the first q of each kind: the matrices of scale factors and misalignments (element (i, j) at
/// 3 j + i, so that the columns belong together), the lever arm, and the master's correlated error.
enum ConsideredIndex : int { accel_matrix = 0, gyro_matrix = 9, lever_arm = 18, master_error = 21 };
/// The number of considered errors.
inline constexpr int considered_count = 24;
using Sensitivity = Eigen::Matrix<double, state_count, considered_count>;

/// Whether the settings state at least one error to consider.
bool considers(const Settings& settings);

/// What the IMU measured since the last prediction, in body axes.
struct Measured {
  Eigen::Vector3d delta_v = Eigen::Vector3d::Zero();      // [m/s]
  Eigen::Vector3d delta_theta = Eigen::Vector3d::Zero();  // [rad]
};

/// Predicts over an interval whose transition is I + G: P already has (I + G) P (I + G)', and receives what S
/// and the errors of the IMU's matrices add.
void predict_considered(Covariance& P, Sensitivity& S, const Covariance& G, const Interval& interval,
                        const Measured& measured, const Settings& settings);

/// The partial derivative of V_slave - V_master with respect to the last q, from the lever arm on.
using DifferenceOf = Eigen::Matrix<double, 3, 6>;
/// The measurement update of P by the difference of the velocities of slave and master. Like
/// filtering::update_states(), with the slave at a lever arm and a master with a correlated error; see
/// difference_of().
filtering::Correction<state_count, 3> update_considered(const Covariance& P, const Sensitivity& S,
                                                        const DifferenceOf& H, const Eigen::Matrix3d& R,
                                                        const Eigen::Vector3d& innovation);
/// The share of each variance of the innovation that comes from the considered errors.
Eigen::Vector3d considered_share(const Sensitivity& S, const DifferenceOf& H,
                                 const Eigen::Matrix3d& innovation);
/// S after this update.
void correct_considered(Sensitivity& S, const Eigen::Matrix<double, state_count, 3>& K,
                        const DifferenceOf& H);
/// The partial derivative of V_slave - V_master with respect to lever arm and master error, for an attitude
/// and a rate omega_ib_b [rad/s].
DifferenceOf difference_of(const Eigen::Matrix3d& C_bn, const Eigen::Vector3d& omega_ib_b,
                           const Settings& settings);

}  // namespace canhil::transfer_alignment
