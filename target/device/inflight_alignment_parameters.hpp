// The parameters of in-flight alignment that a bench can set.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "target/device/parameter_table.hpp"
#include "target/estimators/inflight_alignment/settings.hpp"

namespace canhil::target {

/// The values that the parameters set.
struct InflightTuning {
  inflight_alignment::Settings filter;
  double height_sigma = 0;  // of the height; 0: equal to the sigma of north and east
  std::int64_t output_interval_us = 0;
};

/// The parameters, each in the unit that its name states. The defaults fit the sensors of Kang, Kim, Park
/// 2006 with an SSBL.
inline constexpr std::array inflight_alignment_parameters = [] {
  namespace ia = inflight_alignment;
  using Row = ParameterTable<InflightTuning>::Row;
  using P = messages::Parameter;
  constexpr double deg = std::numbers::pi / 180, degph = deg / 3600, degprth = deg / 60, ug = 1e-6 * 9.80665;
  constexpr bool whole = true, real = false, any_time = true, stopped_only = false;
  return std::array{
      Row{P::accel_bias_sigma_ug, 1000, 0, 1e6, real, stopped_only,
          "1-sigma of the accelerometer biases at the start.",
          [](InflightTuning& t, double v) { t.filter.accel_bias_sigma_0 = v * ug; }},
      Row{P::gyro_bias_sigma_degph, 1, 0, 1e6, real, stopped_only, "1-sigma of the gyro biases at the start.",
          [](InflightTuning& t, double v) { t.filter.gyro_bias_sigma_0 = v * degph; }},
      Row{P::accel_noise_ugprthz, 50, 0, 1e6, real, any_time,
          "Density that the filter assumes for the accelerometers' white noise.",
          [](InflightTuning& t, double v) { t.filter.accel_noise_density = v * ug; }},
      Row{P::gyro_noise_degprth, 0.3, 0, 1e4, real, any_time,
          "Density that the filter assumes for the gyros' white noise.",
          [](InflightTuning& t, double v) { t.filter.gyro_noise_density = v * degprth; }},
      Row{P::closed_loop, 1, 0, 1, whole, stopped_only,
          "`ekf`, `ukf`: whether the filter corrects the INS. 0: no; 1: yes. `sin_cos` always corrects the "
          "INS.",
          [](InflightTuning& t, double v) { t.filter.closed_loop = v > 0.5; }},
      Row{P::output_interval_ms, 10, 1, 1000, real, any_time, "Minimum time between navigation answers.",
          [](InflightTuning& t, double v) { t.output_interval_us = std::llround(v * 1e3); }},
      Row{P::aiding, 0, 0, 1, whole, stopped_only,
          "Sensor whose fixes the filter uses. 0: SSBL; 1: GPS. Fixes of the other sensor are refused.",
          [](InflightTuning& t, double v) { t.filter.aiding = static_cast<ia::Aiding>(std::lround(v)); }},
      Row{P::attitude_error_frame, 0, 0, 1, whole, stopped_only,
          "`ekf`, `ukf` with `closed_loop` 1: axes in which the tilts are fed back. 0: platform axes, as "
          "published; 1: navigation axes.",
          [](InflightTuning& t, double v) {
            t.filter.attitude_error_frame = static_cast<ia::AttitudeErrorFrame>(std::lround(v));
          }},
      Row{P::ukf_root, 0, 0, 1, whole, stopped_only,
          "`ukf`: square root of the covariance. 0: lower Cholesky factor; 1: symmetric root.",
          [](InflightTuning& t, double v) { t.filter.ukf_root = static_cast<ia::UkfRoot>(std::lround(v)); }},
      Row{P::ukf_covariance, 0, 0, 1, whole, stopped_only,
          "`ukf`: point about which the covariance is computed. 0: the mean; 1: the transformed central "
          "point.",
          [](InflightTuning& t, double v) {
            t.filter.ukf_covariance = static_cast<ia::UkfCovariance>(std::lround(v));
          }},
      Row{P::fix_noise_horizontal_m, 2, 1e-3, 1e4, real, any_time,
          "1-sigma that the filter assumes for a fix, in north and east. If a fix reports a larger sigma, "
          "the "
          "filter uses the reported sigma.",
          [](InflightTuning& t, double v) { t.filter.fix_noise_horizontal = v; }},
      Row{P::fix_noise_vertical_m, 2, 1e-3, 1e4, real, any_time,
          "The same as `fix_noise_horizontal_m`, for the height.",
          [](InflightTuning& t, double v) { t.filter.fix_noise_vertical = v; }},
      Row{P::fix_bias_sigma_m, 3.1622777, 0, 1e4, real, stopped_only,
          "1-sigma that the filter assumes for the constant error of SSBL fixes, which is the sum of the "
          "errors of ship and SSBL.",
          [](InflightTuning& t, double v) { t.filter.fix_bias_sigma_0 = v; }},
      Row{P::fix_bias_walk_mprts, 0, 0, 1e3, real, any_time,
          "Density of the random walk of the error that `fix_bias_sigma_m` describes; 0: the error is "
          "constant.",
          [](InflightTuning& t, double v) { t.filter.fix_bias_noise_density = v; }},
      Row{P::fix_correlated_percent, 100, 0, 100, real, stopped_only,
          "`sin_cos`: share of the variance of a fix's noise that is correlated in time. 0: the noise is "
          "white.",
          [](InflightTuning& t, double v) { t.filter.fix_correlated_share = v / 100; }},
      Row{P::fix_correlation_s, 0, 0, 1e5, real, any_time,
          "`sin_cos`: correlation time of this share. 0: not known; the sigmas then cover all times from 5 "
          "to 120 s.",
          [](InflightTuning& t, double v) { t.filter.fix_correlation_time = v; }},
      Row{P::initial_height_sigma_m, 0, 0, 1e5, real, stopped_only,
          "1-sigma of the height at the start; 0: the filter uses `position_m` of `[target.initial_sigma]`.",
          [](InflightTuning& t, double v) { t.height_sigma = v; }},
      Row{P::handover_sigma_deg, 2, 1e-3, 90, real, any_time,
          "`sin_cos`: if the sigma of the heading is below this value, the filter treats the heading as "
          "resolved and feeds it back to the INS.",
          [](InflightTuning& t, double v) { t.filter.handover_sigma = v * deg; }},
      Row{P::gate_nis, 30, 0, 1e9, real, any_time,
          "Fixes whose normalised innovation squared (NIS) is larger than this value are refused; in "
          "`sin_cos`, half of it after a refused fix. 0: no gate.",
          [](InflightTuning& t, double v) { t.filter.gate_nis = v; }},
      Row{P::gate_recovery, 5, 0, 1e6, whole, any_time,
          "The gate refuses at most this number of fixes in a row. The filter uses the next fix even if it "
          "is beyond the gate.",
          [](InflightTuning& t, double v) {
            t.filter.gate_recovery = static_cast<std::uint32_t>(std::lround(v));
          }},
      Row{P::late_fixes, 1, 0, 1, whole, stopped_only,
          "1: a late fix is applied at its time of validity; 0: it is applied when it arrives.",
          [](InflightTuning& t, double v) {
            t.filter.late_fixes = static_cast<ia::LateFixes>(std::lround(v));
          }},
  };
}();

}  // namespace canhil::target
