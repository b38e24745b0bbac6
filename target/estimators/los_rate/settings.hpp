#pragma once
// Settings of the LOS-rate estimator. Defaults: the engagement of NOTES.md at 200 Hz.
#include <cstdint>

namespace canhil::los_rate {

/// How the gain is computed.
enum class Algorithm : std::uint8_t {
  switched_table,  // the paper's: P-bar tables for thermal and glint noise, switched where both are equal
  combined,        // one gain for the sum of all noises, tabulated in range and closing speed
  kalman,          // the full time-varying Kalman filter: the reference
  low_pass,        // classical: second order, fixed bandwidth, antenna rate added
};

/// A pair of planes: pitch (about y, positive nose up) and yaw (about z, positive nose right).
template <class Value>
struct Planes {
  Value pitch{}, yaw{};
  bool operator==(const Planes&) const = default;
};

/// White noise of an error angle, as 1-sigma values. The variance of a sample is R(r) = thermal^2 r^4 +
/// glint^2 / r^2 + constant^2.
struct Noise {
  double thermal = 1e-10;  // of an active radar [rad/m^2]
  double glint = 0.5;      // [m]
  double constant = 0;     // [rad]
  bool operator==(const Noise&) const = default;
};

/// The settings of the estimator.
struct Settings {
  Algorithm algorithm = Algorithm::combined;
  Planes<Noise> noise;
  double jerk_density = 300;     // q: PSD of the target's jerk [m^2/s^5]
  double sample_period = 0.005;  // noise and gains refer to this period; a step may be longer [s]

  double rate_sigma_0 = 0.05;        // of the LOS rate at the start [rad/s]
  double acceleration_sigma_0 = 40;  // of the target at the start [m/s^2]
  double start_up = 2.5;             // time of the Kalman filter before a closed gain takes over [s]
  double gap_limit = 0.05;           // longest bridged gap; a longer coast restarts the Kalman filter [s]
  double longest_step = 0.5;         // longer steps are refused [s]

  double low_pass_bandwidth = 8;  // [rad/s]
  double low_pass_damping = 0.70710678118654752;

  double range_max = 10'000;           // end of the combined table [m]
  double closing_speed_max = 2000;     // end of both tables [m/s]
  double blind_range = 50;             // lower limit of least_range() [m]
  double range_sigma = 15;             // of the range, bias included, near the blind range [m]
  double range_gate = 100;             // a larger deviation from the extrapolation is a jump [m]
  double closing_speed_gate = 100;     // likewise for the closing speed [m/s]
  int relock_samples = 10;             // a jump is accepted after this many agreeing samples in a row
  double range_unchanged_limit = 0.1;  // a range that does not change for longer is stale [s]

  double field_of_view = 0.15;              // largest error angle off the antenna's axis [rad]
  double antenna_rate_bias_sigma = 0;       // of a lasting error of the antenna rate, each plane [rad/s]
  double antenna_rate_sigma = 0.5;          // of an antenna rate that was not measured [rad/s]
  double missile_acceleration_sigma = 100;  // of a missile acceleration that was not measured [m/s^2]
};

}  // namespace canhil::los_rate
