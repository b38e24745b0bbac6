#pragma once
// Settings of the wind estimator. Defaults: the recommended filter (NOTES.md), at 50 Hz.
#include <Eigen/Core>
#include <cstdint>
#include <numbers>

namespace canhil::wind {

/// One degree [rad].
inline constexpr double rad_per_deg = std::numbers::pi / 180;

/// The recursion.
enum class Algorithm : std::uint8_t {
  ekf,
  h_infinity,  // the paper's
  adaptive_q,  // EKF that adapts the noise of rates or coefficients to the innovation statistic
};

/// How the process noise enters the states.
enum class ProcessNoise : std::uint8_t {
  block_diagonal,  // presumably the paper's: the wind's noise does not enter the air velocity
  correlated,      // the wind's noise enters the air velocity: v_a' = ... - C v_w'
  aerodynamic,     // correlated, plus noise from coefficient errors in proportion to the current loads
  likeliest,       // several filters with different noise, weighted by their likelihood (bank.hpp)
};

/// True if the noise depends on the aerodynamic loads.
constexpr bool follows_loads(ProcessNoise noise) {
  return noise == ProcessNoise::aerodynamic || noise == ProcessNoise::likeliest;
}

/// Process noise, densities per sqrt(s).
struct Densities {
  double air_velocity = 0.02;            // [m/s]
  double rate = 0.2 * rad_per_deg;       // [rad/s]
  double attitude = 0.01 * rad_per_deg;  // [rad]
  double wind = 0.3;                     // includes wind shear times sink rate [m/s]
  double coefficient = 0.0022;  // relative, of each part of each coefficient: 1 %, constant for 50 ms
};

/// The settings of the estimator.
struct Settings {
  Algorithm algorithm = Algorithm::adaptive_q;
  ProcessNoise process_noise = ProcessNoise::likeliest;
  Densities density;

  // Lasting errors that the reported sigmas allow for (NOTES.md), 1-sigma.
  double coefficient_sigma = 0.05;                  // relative, of each part of each coefficient
  double velocity_bias_sigma = 0.25;                // of navigation, each axis [m/s]
  double attitude_bias_sigma = 0.25 * rad_per_deg;  // of navigation, each angle [rad]

  double velocity_sigma = 0.25;                // of a navigation sample's ground velocity, NED [m/s]
  double rate_sigma = 0.125 * rad_per_deg;     // [rad/s]
  double attitude_sigma = 0.25 * rad_per_deg;  // [rad]
  double sample_period = 0.02;                 // of navigation [s]

  double theta_per_s = 1.5;    // H-infinity: theta of a sample, divided by its interval [1/(m/s)^2/s]
  double theta_cap_per_s = 2;  // bound of theta lambda_max, divided by the same interval [1/s]
  double rate_weight = 1;  // weight of the rates in S; the air velocity has the weight 1 [(m/s)^2/(rad/s)^2]

  double adaptation_time = 0.3;   // time constant of the adapted noise if NIS/9 is 2 [s]
  double adaptation_limit = 1e4;  // upper limit of the factor on the variance of the adapted noise

  double gust_noise = 12;       // of the wind, for the bank's gust filter [m/s/sqrt(s)]
  double memory = 1;            // of the bank's likelihoods [s]
  double odds_of_gusts = 1e-3;  // prior weight of the gust filter relative to the other filter

  double air_velocity_sigma_0 = 1;              // of the air velocity that is known at the start [m/s]
  double velocity_sigma_0 = 0.1;                // ground velocity at the start [m/s]
  double rate_sigma_0 = 0.01 * rad_per_deg;     // [rad/s]
  double attitude_sigma_0 = 0.1 * rad_per_deg;  // [rad]
  double wind_sigma_0 = 20;                     // of each component, for an unknown wind [m/s]

  Densities degraded{1, 10 * rad_per_deg, 0.01 * rad_per_deg, 0.3, 0};  // minimum if the model is unreliable
  double longest_prediction = 0.025;                                    // longer steps are divided [s]
  double coast_limit = 2;           // after a longer time without navigation the filter restarts [s]
  double stale_limit = 0.1;         // navigation that does not change for longer is stale [s]
  double fins_late = 0.03;          // the estimate is flagged if deflections are older [s]
  double fins_missing = 0.1;        // the model is unreliable if deflections are older [s]
  double velocity_gate = 50;        // a larger innovation is refused as a jump [m/s]
  double attitude_gate = 0.5;       // likewise [rad]
  int jumps_limit = 25;             // the filter restarts at this many jumps in a row
  double ground_speed_most = 1000;  // a faster navigation sample is not physical [m/s]
  double rate_most = 10;            // likewise [rad/s]
};

/// True if the reported sigmas include the effect of lasting errors of coefficients and navigation. Those of
/// the H-infinity filter never do.
constexpr bool considers_lasting_errors(const Settings& settings) {
  return follows_loads(settings.process_noise) && settings.algorithm != Algorithm::h_infinity;
}

}  // namespace canhil::wind
