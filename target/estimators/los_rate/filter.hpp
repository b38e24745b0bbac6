#pragma once
// Estimates the LOS rate of a seeker with gains that depend only on range and closing speed (Na and Lee), in
// two planes, which roll couples. Call make_design() at start-up, then initial(), then step() at each sample.
// NOTES.md has equations, signs and corrections.
#include <cstdint>

#include "target/estimators/los_rate/design.hpp"
#include "target/estimators/los_rate/motion.hpp"
#include "target/estimators/los_rate/range_track.hpp"

namespace canhil::los_rate {

/// One sample of the seeker, with increments over the `interval` that ends at this sample.
struct Measurement {
  double dt = 0;                       // since the last step [s]
  double interval = 0;                 // [s]; less than dt: samples were lost before; 0: equal to dt
  Planes<double> error{};              // LOS off the antenna's axis [rad]
  Planes<double> antenna_increment{};  // antenna's inertial rotation about y, z [rad]
  double roll_increment = 0;           // about x [rad]
  Planes<double>
      missile_acceleration{};  // mean along antenna z (pitch) and y (yaw), gravity included [m/s^2]
  RangeSample range{};
  bool error_valid = false, antenna_valid = false, acceleration_valid = false;
};

/// All that the filter keeps between two samples.
struct State {
  Plane error, rate, acceleration;  // of the LOS and the target
  Plane drift;                      // recent mean of the innovations [rad]
  Planes<double> lag{};             // of the rate, as this mean shows it [rad/s]; combined only
  Motion motion;                    // the last measurement of each component
  bool motion_known = false;        // the last sample contained all components that the algorithm uses
  Planes<Covariance> P;             // valid if `covariance`; only pitch if the noises are equal
  RangeTrack track;
  double start_up_s = 0;  // remaining time of the Kalman filter
  double coasted_s = 0;   // time since the last update
  bool started = false;
  bool covariance = false;  // P is propagated: Kalman filter or coasting
};

/// What a step did.
enum class Outcome : std::uint8_t {
  waiting,     // no usable range and error angle yet
  started,     // the first sample: its error angle starts the estimate
  updated,     // with the algorithm's own gain; after a gap or a coast with a Kalman gain
  start_up,    // updated by the Kalman filter that runs before the closed gain
  coasting,    // predicted only; `fault` is the reason
  bad_step,    // dt not positive, not finite or too long: ignored
  non_finite,  // the result would not be finite: ignored
};

/// The result of a step.
struct UpdateResult {
  Outcome outcome = Outcome::bad_step;
  Fault fault = Fault::none;  // the first fault found, whether or not the estimate coasts
  bool blind = false;         // below the least range: range is clamped, guidance must hold its command
  Planes<double> innovation;  // [rad]
  Planes<double> innovation_variance{1, 1};  // [rad^2]
  double nis = 0;                            // of both planes (2 degrees of freedom); 0 without an update
  Planes<Sigma> sigma;                       // after the step
  Planes<double> lag{};                      // State::lag after the step
  Geometry used;                             // in gain and transition: range (clamped) and closing speed
};

/// LOS error angle [rad], LOS rate [rad/s] about y and z, target acceleration [m/s^2] along z and y.
struct Estimate {
  Planes<double> error, rate, acceleration;
};

/// The state before the first sample.
State initial();

/// Processes one sample: prediction, and an update if the sample has all inputs of the algorithm. No
/// allocation, no exception; never leaves a NaN in the state.
UpdateResult step(State& state, const Measurement& measurement, const Design& design);

/// The sigmas to report for a step. Those of Algorithm::combined include the lag after a sudden turn of the
/// target, which white jerk does not model. After a step A of the acceleration, the rate of a filter with
/// third-order Butterworth poles of bandwidth Om lags by up to 0.885 A/(Om r). The lag for
/// A = acceleration_sigma_0 is taken as 2 sigma. A larger lag shows in the innovations (note_lag()).
Planes<Sigma> reported_sigma(const UpdateResult& result, const Design& design);

/// The estimate of a state, with the signs of pitch and yaw.
Estimate estimate(const State& state);

/// Predicts the three states over one step; `end` is the geometry at the end of the step. Error angle and
/// rate follow transition() with the input a - a_m; the antenna increment is subtracted from the error angle;
/// then the states are turned by the roll increment. Inputs are given in the axes at mid-roll, so they are
/// turned by only half of the roll.
void predict(State& state, Geometry end, double dt, Plane antenna_increment, Plane missile_acceleration,
             double roll_increment);

/// x += K innovation, each plane with its own gain.
void correct(State& state, Plane innovation, const Planes<Gain>& gain);

}  // namespace canhil::los_rate
