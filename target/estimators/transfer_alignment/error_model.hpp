#pragma once
// The 12-state velocity and attitude error model of a slave INS; every error = computed - true.
// x = [dV (NED), phi (NED), accelerometer bias error (body), gyro bias error (body)],
// C_computed = exp(-[phi x]) C_true:
//   dV'  = -(2 w_ie + w_en) x dV + (C f) x phi + C df + white
//   phi' = -(w_ie + w_en) x phi - C dw + white
// (Yang, Shim, Park 2001, eqs. (1)-(5); corrected: blocks (1,1) and (2,2) of A are skew matrices).
#include <Eigen/Core>
#include <array>

#include "target/estimators/filtering/block_transition.hpp"
#include "target/estimators/strapdown/interval.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

/// The number of states.
inline constexpr int state_count = 12;
using StateVector = Eigen::Matrix<double, state_count, 1>;
using Covariance = Eigen::Matrix<double, state_count, state_count>;

/// The index of the first of the three states of each error.
enum Index : int { velocity_state = 0, attitude_state = 3, accel_bias_state = 6, gyro_bias_state = 9 };

using strapdown::Interval;  // since the last update

/// The non-zero blocks of G = A dt; the H2 filter adds (P N'N/beta) dt, which makes every block of the
/// attitude column non-zero.
inline constexpr std::array<filtering::Block, 5> kalman_blocks{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 3}}};
/// The non-zero blocks with the H2 term.
inline constexpr std::array<filtering::Block, 7> h2_blocks{
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 3}, {2, 1}, {3, 1}}};

/// G = A dt [12 x 12] for the interval: Phi = I + G.
Covariance transition_increment(const Interval& interval);

/// The diagonal of Q dt: white noise of the accelerometers on dV and of the gyros on phi.
StateVector process_noise(const Settings& settings, double duration);

/// The diagonal of P at the start.
StateVector initial_variance(const Settings& settings);

}  // namespace canhil::transfer_alignment
