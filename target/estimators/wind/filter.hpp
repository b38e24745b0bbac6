#pragma once
// Wind of an unpowered glider without an air-speed sensor, from its ground velocity, attitude, rates, fins
// and aerodynamic model (Park and Park 2019). Call make_design() and initial() at the start,
// FinHistory::push() at each frame of the fins, step() at each sample of navigation, then estimate().
// NOTES.md has the equations and corrections.
#include <cstdint>
#include <optional>

#include "target/estimators/wind/estimate.hpp"
#include "target/estimators/wind/fin_history.hpp"
#include "target/estimators/wind/recursion.hpp"

namespace canhil::wind {

/// One sample of the glider's GPS/INS.
struct Navigation {
  std::int64_t t_us = 0;     // time of validity
  Eigen::Vector3d v_eb_n;    // ground velocity, NED [m/s]
  Eigen::Vector3d omega;     // rates, body [rad/s]
  Eigen::Vector3d attitude;  // roll, pitch, heading [rad]
  double altitude = 0;       // [m]
  bool valid = false;
};

/// The state of a filter between two samples.
struct State {
  StateVector x = StateVector::Zero();
  Covariance P = Covariance::Identity();
  Sensitivity sensitivity = Sensitivity::Zero();  // if considers_lasting_errors()
  bool started = false;                           // false: only the wind in x and P is valid
  std::optional<std::int64_t> t_us;
  bool sample_used = false;                // the sample of t_us was used
  double altitude = 0;                     // at t_us [m]
  double coasted_s = 0;                    // since the last update
  double noise_factor = 1;                 // adaptive_q: factor on the variance of the process noise
  int jumps = 0;                           // navigation samples refused as jumps in a row
  double unchanged_s = 0;                  // time since navigation changed
  Observation last = Observation::Zero();  // the last navigation sample
};

/// What a step did.
enum class Outcome : std::uint8_t {
  waiting,  // not started, and this sample is not usable
  started,  // the filter started from attitude, rates and velocity of the sample, and from the previous wind
  updated,
  coasting,      // predicted only; `fault` is the reason
  out_of_order,  // valid before the last sample, or at the time of a last sample that was used: ignored
  non_finite,    // the result would not be finite and positive definite: restarts with the next sample
};

/// Why a sample of navigation was not used.
enum class Fault : std::uint8_t {
  none,
  invalid,  // flagged by navigation
  not_finite,
  not_physical,  // speed, rate or angle
  pitch,         // too near +-90 deg for Euler angles
  stale,         // unchanged for too long
  jump,          // innovation beyond the gate
};

/// Reasons why the estimate is less reliable.
struct Flags {
  RangeFlags outside;      // outside the range of the aerodynamic model, the atmosphere or the Euler angles
  bool fins_late = false;  // a deflection is missing or too old
  bool fins_missing = false;       // no deflection for so long that the model is unreliable
  bool fins_not_physical = false;  // the last frame of the fins was refused
  bool theta_capped = false;       // H-infinity: theta was lowered
  /// True if the process noise was raised to Settings::degraded.
  bool degraded() const { return outside.any() || fins_missing; }
};

/// The result of a step.
struct UpdateResult {
  Outcome outcome = Outcome::waiting;
  Fault fault = Fault::none;
  Flags flags;
  Observation innovation = Observation::Zero();  // ground velocity, rates, Euler angles
  Observation normalised = Observation::Zero();  // innovation, whitened (correction.hpp)
  Observation lasting = Observation::Zero();     // variance by lasting errors, per variance by noise
  double nis = 0;                                // 9 degrees of freedom; 0 without an update
  double surprise = 0;                           // nis + ln det S; 0 without an update
  double theta = 0;                              // H-infinity, as used
};

/// P plus the effect of lasting errors: P + S diag(sigma^2) S' (Schmidt's considered
/// parameters with an unchanged gain: Jazwinski 1970, sect. 8.4).
Covariance reported_covariance(const State& state, const Settings& settings);

/// The known state at release. The wind follows from the air velocity, which the carrier provides.
struct Start {
  std::int64_t t_us = 0;
  Eigen::Vector3d air_velocity;  // body [m/s]
  Eigen::Vector3d v_eb_n;        // NED [m/s]
  Eigen::Vector3d omega;         // [rad/s]
  Eigen::Vector3d attitude;      // roll, pitch, heading [rad]
  double altitude = 0;           // [m]
};

/// The state before a start. It contains only a wind [m/s, NED] with the sigma settings.wind_sigma_0.
State initial(const Design& design, const Eigen::Vector3d& wind = Eigen::Vector3d::Zero());

/// The state at release, with the sigmas of the settings and with the wind v_eb_n - C_bn v_a.
State initial(const Start& start, const Design& design);

/// Processes one sample: prediction with the deflections since the last sample, and an update if the sample
/// is usable. No allocation, no exception; never leaves a NaN in the state.
UpdateResult step(State& state, const Navigation& navigation, const FinHistory& fins, const Design& design);

/// The estimates after the last sample.
inline Estimate estimate(const State& state) { return estimate(state.x); }
/// The sigmas after the last sample.
inline Uncertainty uncertainty(const State& state) { return uncertainty(state.x, state.P); }

}  // namespace canhil::wind
