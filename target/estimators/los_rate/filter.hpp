#pragma once
// LOS rate of a seeker by range-only gains (Na and Lee), in two planes with roll coupling. make_design() at
// start-up, initial(), then step() at each sample; NOTES.md for equations, signs and corrections.
#include <cstdint>

#include "target/estimators/los_rate/design.hpp"
#include "target/estimators/los_rate/motion.hpp"
#include "target/estimators/los_rate/range_track.hpp"

namespace canhil::los_rate {

/// One sample of the seeker; increments over the `interval` that ends at it.
struct Measurement {
  double dt = 0;                       // since the last step [s]
  double interval = 0;                 // shorter than dt: samples were lost before this one; 0: dt [s]
  Planes<double> error{};              // LOS off the antenna's axis [rad]
  Planes<double> antenna_increment{};  // antenna's inertial rotation about y, z [rad]
  double roll_increment = 0;           // about x [rad]
  Planes<double>
      missile_acceleration{};  // mean along antenna z (pitch) and y (yaw), gravity included [m/s^2]
  RangeSample range{};
  bool error_valid = false, antenna_valid = false, acceleration_valid = false;
};

struct State {
  Plane error, rate, acceleration;  // of the LOS and the target
  Motion motion;                    // the last measured of each
  bool motion_known = false;        // by the last sample
  Planes<Covariance> P;             // while `covariance` is set; in pitch alone where the noises are equal
  RangeTrack track;
  double start_up_s = 0;  // of Kalman filter still to come
  double coasted_s = 0;   // since the last update
  bool started = false;
  bool covariance = false;  // P is carried on: Kalman filter or coasting
};

enum class Outcome : std::uint8_t {
  waiting,     // no usable range and error angle yet
  started,     // the first sample: error angle taken over
  updated,     // by the algorithm's own gain; after a gap or a coast by a Kalman gain
  start_up,    // by the Kalman filter before the closed gain
  coasting,    // predicted only; `fault` says why
  bad_step,    // dt not positive, not finite or too long: nothing done
  non_finite,  // the result would not be finite: nothing done
};

struct UpdateResult {
  Outcome outcome = Outcome::bad_step;
  Fault fault = Fault::none;  // the first that was found, whether or not it made the estimate coast
  bool blind = false;         // below the least range: range is clamped, guidance is to hold its command
  Planes<double> innovation;  // [rad]
  Planes<double> innovation_variance{1, 1};  // [rad^2]
  double nis = 0;       // of both planes: chi-square of 2 if consistent; 0 without an update
  Planes<Sigma> sigma;  // after the step
  Geometry used;        // range (clamped) and closing speed that gain and transition saw
};

/// LOS error angle [rad], LOS rate [rad/s] about y and z, target acceleration [m/s^2] along z and y.
struct Estimate {
  Planes<double> error, rate, acceleration;
};

/// The state before the first sample.
State initial();

/// One sample: prediction, and an update if the sample has what the algorithm needs. No allocation, no
/// exception; never leaves a NaN in the state.
UpdateResult step(State& state, const Measurement& measurement, const Design& design);

/// Sigmas to be told of a step. `combined` allows for what no white jerk does, a turn of the target all at
/// once: the rate lags by up to 0.885 a/(Om r) (third-order Butterworth poles of bandwidth Om, a step of the
/// acceleration), and with a = acceleration_sigma_0 that counts as an event of 3 sigma.
Planes<Sigma> told_sigma(const UpdateResult& result, const Design& design);

/// The state in the planes' own signs.
Estimate estimate(const State& state);

/// Prediction of the three states over dt that ends at `end` (transition()): input a - a_m through the third
/// column, less the antenna increment, then turned by the roll; inputs measured in mid-turn by half of it.
void predict(State& state, Geometry end, double dt, Plane antenna_increment, Plane missile_acceleration,
             double roll_increment);

/// x += K innovation, each plane with its own gain.
void correct(State& state, Plane innovation, const Planes<Gain>& gain);

}  // namespace canhil::los_rate
