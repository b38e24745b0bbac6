#pragma once
// Velocity-matching transfer alignment (Yang, Shim, Park 2001): aligns a slave INS to a master's velocity by
// a Kalman or a robust H2 filter. Call initial() once, propagate() at IMU rate, update() at each velocity of
// the master.
#include <Eigen/Core>
#include <cstdint>

#include "target/estimators/strapdown/mechanization.hpp"
#include "target/estimators/transfer_alignment/considered.hpp"
#include "target/estimators/transfer_alignment/error_model.hpp"
#include "target/estimators/transfer_alignment/settings.hpp"

namespace canhil::transfer_alignment {

/// The slave INS: the part of the state that an IMU sample changes. A copy of an Ins is a snapshot of the
/// INS; the assignment of the copy restores this state.
struct Ins {
  strapdown::NavState nav;
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  // estimate, subtracted from the IMU [m/s^2]
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   // [rad/s]
  strapdown::ImuIncrement previous;                      // the last increment, bias-corrected
  Interval interval;                                     // since the last update or prediction
  Measured measured;                                     // in this interval
  double since_velocity = 0;                             // time since the last update [s]
};

/// All that the filter keeps between two samples.
struct State {
  Ins ins;
  Covariance P;                // posterior of the last update, or of the last prediction after it
  StateVector x;               // estimated errors of ins at the last update; zero in a closed loop
  std::uint32_t rejected = 0;  // number of consecutive gated velocities
  Sensitivity S;               // zero unless the settings state errors to consider
  double velocity_period = 0;  // of the master [s]
  double velocity_wait = 0;    // between the last two velocities [s]
  bool degraded = false;       // UpdateResult::degraded of a prediction since the last update
};

/// The outcome of an update by a velocity of the master.
enum class Outcome : std::uint8_t {
  ok,
  gated,                  // NIS above the gate
  no_interval,            // no IMU sample since the last update
  non_finite,             // a NaN or infinity in the measurement or in the result
  not_positive_definite,  // the innovation covariance, or P has a negative variance
  not_reached,            // from History: velocity valid after the newest IMU epoch
  out_of_order,           // from History: velocity valid before the last update
  older_than_history,     // from History: velocity valid before the oldest stored epoch
};

/// The result of an update. Unless outcome is ok, the update changed only the count of gated velocities.
struct UpdateResult {
  Outcome outcome = Outcome::no_interval;
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();  // V_slave - V_master, minus x in an open loop [m/s]
  Eigen::Matrix3d innovation_covariance = Eigen::Matrix3d::Zero();  // [(m/s)^2]
  // The share of each variance of the innovation that comes from errors that the filter considers.
  Eigen::Vector3d lasting = Eigen::Vector3d::Zero();
  double nis = 0;                        // chi-squared, 3 degrees of freedom
  StateVector dx = StateVector::Zero();  // K innovation: the correction
  double alpha = 0;                      // H2 [m/s^2]
  double beta = 0;                       // H2; 0: a Kalman step without H2 terms
  bool degraded = false;  // H2 with Loop::invariant: P of the attitude exceeded P0, so this was a Kalman step
};

/// The state at the start of an alignment: `nav` is the navigation state of the slave INS; P0 follows from
/// the settings.
State initial(const strapdown::NavState& nav, const Settings& settings);

/// Processes one IMU increment (dt > 0): removes the estimated biases, advances the INS, and extends the
/// integrals since the last update (Ins::interval).
void propagate(State& state, const strapdown::ImuIncrement& imu, const Settings& settings);

/// Whether a velocity is so late that the filter predicts without it. Only with Loop::invariant: one step
/// over an outage would be too long for a prediction of the first order.
bool prediction_is_due(const State& state, const Settings& settings);
/// Predicts P to the INS's epoch.
void predict(State& state, const Settings& settings);

/// Processes the master's velocity [m/s, NED] valid at the last IMU epoch: propagates P over the interval
/// since the last update in one step, updates P by the measurement, and in a closed loop corrects the INS.
UpdateResult update(State& state, const Eigen::Vector3d& master_velocity, const Settings& settings);

/// update() with the difference V_slave - V_master [m/s], for a caller that has interpolated V_slave.
UpdateResult update_with_difference(State& state, const Eigen::Vector3d& difference,
                                    const Settings& settings);

/// The covariance of the errors at the INS's epoch: P, and the bridges over lost IMU samples since.
Covariance reported_covariance(const State& state);

/// The best estimate: the INS itself in a closed loop, the INS minus x (of the last update) in an open loop.
Ins estimate(const State& state);

}  // namespace canhil::transfer_alignment
