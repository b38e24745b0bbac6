// The parameters of the wind estimator that a bench can set.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "target/device/parameter_table.hpp"
#include "target/estimators/wind/settings.hpp"

namespace canhil::target {

/// The values that the parameters set.
struct WindTuning {
  wind::Settings filter;
  std::int64_t output_interval_us = 0;
};

/// The parameters, each in the unit that its name states; the defaults are those of the filter
/// (settings.hpp).
inline constexpr std::array wind_parameters = [] {
  using Row = ParameterTable<WindTuning>::Row;
  using P = messages::Parameter;
  constexpr double deg = wind::rad_per_deg, ms = 1e-3;
  constexpr bool whole = true, real = false, any_time = true, stopped_only = false;
  return std::array{
      Row{P::output_interval_ms, 20, 1, 1000, real, any_time, "Minimum time between answers.",
          [](WindTuning& t, double v) { t.output_interval_us = std::llround(v * 1e3); }},
      Row{P::process_noise, 3, 0, 3, whole, any_time,
          "Model of the process noise. 0: block-diagonal; 1: with the correlation of wind and air velocity; "
          "2: as 1, plus the noise of wrong aerodynamic coefficients; 3: two filters with model 2, one of "
          "which has more wind noise, for gusts. The results of the two filters are weighted by the "
          "likelihood of each filter.",
          [](WindTuning& t, double v) {
            t.filter.process_noise = static_cast<wind::ProcessNoise>(std::lround(v));
          }},
      Row{P::air_velocity_noise_mpsprts, 0.02, 0, 1e3, real, any_time,
          "Density of the process noise of the air velocity.",
          [](WindTuning& t, double v) { t.filter.density.air_velocity = v; }},
      Row{P::body_rate_noise_degpsprts, 0.2, 0, 1e3, real, any_time,
          "Density of the process noise of the body rates. The published filter has 0.05.",
          [](WindTuning& t, double v) { t.filter.density.rate = v * deg; }},
      Row{P::attitude_noise_degprts, 0.01, 0, 1e2, real, any_time,
          "Density of the process noise of the attitude.",
          [](WindTuning& t, double v) { t.filter.density.attitude = v * deg; }},
      Row{P::wind_noise_mpsprts, 0.3, 0, 1e3, real, any_time, "Density of the process noise of the wind.",
          [](WindTuning& t, double v) { t.filter.density.wind = v; }},
      Row{P::coefficient_sigma_percent, 5, 0, 100, real, any_time,
          "1-sigma that the filter assumes for the constant error of each part of an aerodynamic "
          "coefficient. With `process_noise` 2 or 3 the reported sigmas include this error, except with "
          "`h_infinity`.",
          [](WindTuning& t, double v) { t.filter.coefficient_sigma = v / 100; }},
      Row{P::nav_velocity_bias_sigma_mps, 0.25, 0, 100, real, any_time,
          "1-sigma of a lasting error of navigation's velocity, each axis. The reported sigmas allow for it "
          "(`process_noise` 2 and 3).",
          [](WindTuning& t, double v) { t.filter.velocity_bias_sigma = v; }},
      Row{P::nav_attitude_bias_sigma_deg, 0.25, 0, 45, real, any_time,
          "1-sigma of a lasting error of navigation's roll, pitch and heading, likewise.",
          [](WindTuning& t, double v) { t.filter.attitude_bias_sigma = v * deg; }},
      Row{P::glider_velocity_sigma_mps, 0.25, 1e-3, 1e3, real, any_time,
          "1-sigma that the filter assumes for a velocity sample.",
          [](WindTuning& t, double v) { t.filter.velocity_sigma = v; }},
      Row{P::glider_rate_sigma_degps, 0.125, 1e-3, 1e2, real, any_time,
          "1-sigma that the filter assumes for a body rate sample.",
          [](WindTuning& t, double v) { t.filter.rate_sigma = v * deg; }},
      Row{P::glider_attitude_sigma_deg, 0.25, 1e-3, 45, real, any_time,
          "1-sigma that the filter assumes for an attitude sample.",
          [](WindTuning& t, double v) { t.filter.attitude_sigma = v * deg; }},
      Row{P::theta_per_s, 1.5, 0, 1e3, real, any_time,
          "`h_infinity`: the filter's parameter theta is this value multiplied by the interval between "
          "samples (at most 0.1 s). Theta has the unit 1/(m/s)^2, so this value has the unit 1/(m/s)^2/s.",
          [](WindTuning& t, double v) { t.filter.theta_per_s = v; }},
      Row{P::theta_cap_per_s, 2, 0, 1e3, real, any_time,
          "`h_infinity`: sets the upper limit for the product of theta and the largest eigenvalue of the "
          "covariance weighted by S (see `theta_rate_weight`). The limit is this value multiplied by the "
          "interval between samples, but at most 0.9. If the product is above the limit, theta is lowered.",
          [](WindTuning& t, double v) { t.filter.theta_cap_per_s = v; }},
      Row{P::theta_rate_weight, 1, 0, 1e8, real, any_time,
          "`h_infinity`: weight of the body rates in the matrix S, in (m/s)^2/(rad/s)^2. S is diagonal; it "
          "gives the errors of the air velocity the weight 1 and the errors of the body rates this weight.",
          [](WindTuning& t, double v) { t.filter.rate_weight = v; }},
      Row{P::adaptation_time_s, 0.3, 1e-3, 1e3, real, any_time,
          "`adaptive_q`: time constant with which the variance of the process noise follows the NIS.",
          [](WindTuning& t, double v) { t.filter.adaptation_time = v; }},
      Row{P::adaptation_limit, 1e4, 1, 1e8, real, any_time,
          "`adaptive_q`: largest factor by which the variance of the process noise is raised.",
          [](WindTuning& t, double v) { t.filter.adaptation_limit = v; }},
      Row{P::initial_air_velocity_sigma_mps, 1, 1e-3, 1e3, real, stopped_only,
          "1-sigma of the air velocity at the start.",
          [](WindTuning& t, double v) { t.filter.air_velocity_sigma_0 = v; }},
      Row{P::initial_rate_sigma_degps, 0.01, 1e-4, 1e2, real, stopped_only,
          "1-sigma of the body rates at the start.",
          [](WindTuning& t, double v) { t.filter.rate_sigma_0 = v * deg; }},
      Row{P::initial_wind_sigma_mps, 20, 1e-3, 1e3, real, stopped_only,
          "1-sigma of each component of the wind when the filter restarts after jumps; also at the start if "
          "the target receives no initial air velocity.",
          [](WindTuning& t, double v) { t.filter.wind_sigma_0 = v; }},
      Row{P::fins_late_ms, 30, 1, 1e4, real, any_time,
          "Answers have the mark `fins_late` if the deflections of the fins are older than this time.",
          [](WindTuning& t, double v) { t.filter.fins_late = v * ms; }},
      Row{P::fins_missing_ms, 100, 1, 1e4, real, any_time,
          "Answers have the mark `fins_missing` if the deflections of the fins are older than this time.",
          [](WindTuning& t, double v) { t.filter.fins_missing = v * ms; }},
      // The filter bridges a whole gap while it processes one frame: 10 s take 400 parts of 25 ms.
      Row{P::glider_nav_coast_s, 2, 0, 10, real, any_time,
          "The filter bridges gaps between navigation samples up to this length. After a longer gap the "
          "filter restarts.",
          [](WindTuning& t, double v) { t.filter.coast_limit = v; }},
      Row{P::glider_nav_stale_ms, 100, 1, 1e6, real, any_time,
          "Navigation samples that stay exactly the same for longer than this time are treated as stale and "
          "are not used.",
          [](WindTuning& t, double v) { t.filter.stale_limit = v * ms; }},
      Row{P::glider_nav_gate_mps, 50, 1, 1e6, real, any_time,
          "A velocity whose innovation is larger than this value is refused as a jump.",
          [](WindTuning& t, double v) { t.filter.velocity_gate = v; }},
  };
}();

}  // namespace canhil::target
