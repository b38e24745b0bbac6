#pragma once
// What a user may choose of the wind estimator. Defaults: the recommended filter (NOTES.md), at 50 Hz.
#include <Eigen/Core>
#include <cstdint>
#include <numbers>

namespace canhil::wind {

inline constexpr double rad_per_deg = std::numbers::pi / 180;

enum class Algorithm : std::uint8_t {
  ekf,
  h_infinity,  // the paper's
  adaptive_q,  // EKF whose noise of the rates, or of the coefficients, follows the innovation statistic
};

enum class ProcessNoise : std::uint8_t {
  block_diagonal,  // the paper's, presumably: the wind's noise does not reach the air velocity
  correlated,      // v_a' = ... - C v_w': it does
  aerodynamic,     // correlated, and the noise that wrong coefficients make of the loads of the moment
  likeliest,       // several filters, each with another noise, weighted by what was measured (bank.hpp)
};

constexpr bool follows_loads(ProcessNoise noise) {
  return noise == ProcessNoise::aerodynamic || noise == ProcessNoise::likeliest;
}

/// Process noise, densities per sqrt(s).
struct Densities {
  double air_velocity = 0.02;            // [m/s]
  double rate = 0.2 * rad_per_deg;       // [rad/s]
  double attitude = 0.01 * rad_per_deg;  // [rad]
  double wind = 0.3;                     // covers shear times sink rate [m/s]
  double coefficient = 0.0022;  // of each part of each coefficient, as a share of it: 1 % held for 50 ms
};

struct Settings {
  Algorithm algorithm = Algorithm::adaptive_q;
  ProcessNoise process_noise = ProcessNoise::likeliest;
  Densities density;

  double coefficient_sigma = 0.05;  // by which share each part of each coefficient may be wrong for good

  double velocity_sigma = 0.25;                // of a navigation sample: ground velocity, NED [m/s]
  double rate_sigma = 0.125 * rad_per_deg;     // [rad/s]
  double attitude_sigma = 0.25 * rad_per_deg;  // [rad]
  double sample_period = 0.02;                 // of navigation [s]

  double theta_per_s = 1.5;    // H-infinity: theta of a sample over its interval [1/(m/s)^2/s]
  double theta_cap_per_s = 2;  // bound of theta lambda_max over the same interval [1/s]
  double rate_weight = 1;      // of the rates in S, beside 1 of the air velocity [(m/s)^2/(rad/s)^2]

  double adaptation_time = 0.3;   // of the noise that follows, the statistic being 1 too large [s]
  double adaptation_limit = 1e4;  // of the factor on the variance of that noise

  double gust_noise = 4;  // of the wind, for the filter of the bank that believes in gusts [m/s/sqrt(s)]
  double memory = 1;      // of the likelihoods of the bank [s]
  double odds_of_gusts = 1e-3;  // against the other filter, before anything is measured

  double air_velocity_sigma_0 = 1;              // known at the start [m/s]
  double velocity_sigma_0 = 0.1;                // ground velocity at the start [m/s]
  double rate_sigma_0 = 0.01 * rad_per_deg;     // [rad/s]
  double attitude_sigma_0 = 0.1 * rad_per_deg;  // [rad]
  double wind_sigma_0 = 20;                     // of each component, when nothing is known [m/s]

  Densities degraded{1, 10 * rad_per_deg, 0.01 * rad_per_deg, 0.3, 0};  // at the least, where the model is
                                                                        // not to be trusted
  double longest_prediction = 0.025;                                    // a longer step is taken in parts [s]
  double coast_limit = 2;           // without navigation; then the filter starts again [s]
  double stale_limit = 0.1;         // navigation that does not change for longer is stale [s]
  double fins_late = 0.03;          // an older deflection is flagged [s],
  double fins_missing = 0.1;        // and beyond this the model is not to be trusted [s]
  double velocity_gate = 50;        // a larger innovation is a jump and refused ... [m/s]
  double attitude_gate = 0.5;       // [rad]
  int jumps_limit = 25;             // ... until so many came in a row: then the filter starts again
  double ground_speed_most = 1000;  // beyond these a navigation sample is not physical [m/s]
  double rate_most = 10;            // [rad/s]
};

/// The sigmas allow for coefficients that are wrong for good; the H-infinity filter has its own way.
constexpr bool considers_coefficients(const Settings& settings) {
  return settings.coefficient_sigma > 0 && follows_loads(settings.process_noise) &&
         settings.algorithm != Algorithm::h_infinity;
}

}  // namespace canhil::wind
