#pragma once
// Wind of an unpowered glider without an air-speed sensor, from its ground velocity, attitude and rates, its
// fins and its aerodynamic model (Park and Park 2019). make_design() and initial() at the start,
// FinHistory::push() at each frame of the fins, step() at each sample of navigation, estimate(); NOTES.md for
// the equations and what was corrected.
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

struct State {
  StateVector x = StateVector::Zero();
  Covariance P = Covariance::Identity();
  Sensitivity sensitivity = Sensitivity::Zero();  // where considers_coefficients()
  bool started = false;                           // false: of x and P only the wind counts
  std::optional<std::int64_t> t_us;
  bool sample_used = false;                // of t_us
  double altitude = 0;                     // at t_us [m]
  double coasted_s = 0;                    // since the last update
  double noise_factor = 1;                 // of Algorithm::adaptive_q, on the variance
  int jumps = 0;                           // in a row
  double unchanged_s = 0;                  // navigation has not changed for
  Observation last = Observation::Zero();  // navigation, as it came
};

enum class Outcome : std::uint8_t {
  waiting,  // not started, and this sample is not usable
  started,  // attitude, rates and velocity taken over; the wind is what was known of it
  updated,
  coasting,      // predicted only; `fault` says why
  out_of_order,  // not after the last sample: nothing done
  non_finite,    // the result would not be finite and positive definite: starts again with the next sample
};

/// Why a sample of navigation was not used.
enum class Fault : std::uint8_t {
  none,
  invalid,  // says so itself
  not_finite,
  not_physical,  // speed, rate or angle
  pitch,         // too near +-90 deg for Euler angles
  stale,         // has not changed for too long
  jump,          // innovation beyond the gate
};

struct Flags {
  RangeFlags outside;              // of the aerodynamic model, the atmosphere or the Euler angles
  bool fins_late = false;          // a deflection missed, or older than it should be
  bool fins_missing = false;       // none for so long that the model is not to be trusted
  bool fins_not_physical = false;  // the last frame of the fins was refused
  bool theta_capped = false;       // H-infinity: theta was lowered
  bool degraded() const { return outside.any() || fins_missing; }  // process noise was raised
};

struct UpdateResult {
  Outcome outcome = Outcome::waiting;
  Fault fault = Fault::none;
  Flags flags;
  Observation innovation = Observation::Zero();  // ground velocity, rates, Euler angles
  Observation normalised = Observation::Zero();  // the same whitened (correction.hpp)
  double nis = 0;                                // chi-square of 9 if consistent; 0 without an update
  double surprise = 0;                           // that and ln det S; 0 without an update
  double theta = 0;                              // H-infinity, as used
};

/// P, and what coefficients that may be wrong for good add to it: P + sigma^2 S S' (Schmidt's considered
/// parameters with the gain as it is: Jazwinski 1970, sect. 8.4).
Covariance told_covariance(const State& state, const Settings& settings);

/// What is known at release: where the air velocity is (from the carrier), the wind follows.
struct Start {
  std::int64_t t_us = 0;
  Eigen::Vector3d air_velocity;  // body [m/s]
  Eigen::Vector3d v_eb_n;        // NED [m/s]
  Eigen::Vector3d omega;         // [rad/s]
  Eigen::Vector3d attitude;      // roll, pitch, heading [rad]
  double altitude = 0;           // [m]
};

/// The state before a start about which nothing is known but a wind [m/s, NED] of settings.wind_sigma_0.
State initial(const Design& design, const Eigen::Vector3d& wind = Eigen::Vector3d::Zero());

/// The state at release, sigmas from the settings; wind = v_eb_n - C_bn v_a.
State initial(const Start& start, const Design& design);

/// One sample: prediction with the deflections that acted since the last one, and an update if it is usable.
/// No allocation, no exception; never leaves a NaN in the state.
UpdateResult step(State& state, const Navigation& navigation, const FinHistory& fins, const Design& design);

inline Estimate estimate(const State& state) { return estimate(state.x); }
inline Uncertainty uncertainty(const State& state) { return uncertainty(state.x, state.P); }

}  // namespace canhil::wind
