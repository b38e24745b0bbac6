#pragma once
// The design: tables of steady-state gains, computed from the settings at start-up, so that a step solves no
// equation. There is one set of tables if both planes have equal noise, otherwise two.
#include <array>
#include <cmath>

#include "target/estimators/los_rate/closed_form.hpp"
#include "target/estimators/los_rate/settings.hpp"

namespace canhil::los_rate {

/// 1-sigma uncertainty of one plane after an update.
struct Sigma {
  double error = 0;         // [rad]
  double rate = 0;          // [rad/s]
  double acceleration = 0;  // of the target [m/s^2]
};

/// The square roots of the diagonal.
inline Sigma sigma_of(const Covariance& P) { return {std::sqrt(P.ee), std::sqrt(P.ww), std::sqrt(P.aa)}; }

/// A closed gain, i.e. a steady-state gain (discrete, for x) that needs no covariance recursion, and the
/// 1-sigma uncertainty of an update with this gain.
struct ClosedGain {
  Gain K;
  Sigma sigma;
};

/// P-bar (Na and Lee, eqs. (6)-(8)): for thermal noise as a table over the closing speed, for glint as a
/// single value.
struct PBarTable {
  static constexpr int nodes = 33;
  std::array<Covariance, nodes> thermal;  // at closing_speed_max * i / (nodes - 1)
  double nodes_per_speed = 0;
  double thermal_psd = 0;  // thermal^2 Ts
  double crossing_range = 0;
  Covariance glint;
  Gain glint_gain;  // pole-matched, for y
};

/// Pole-matched gain and steady sigmas for the sum of the noises, tabulated over range (equal logarithmic
/// steps) and closing speed. The entries are chosen so that each is nearly constant or nearly proportional to
/// the bandwidth. Therefore linear interpolation is accurate.
struct CombinedTable {
  static constexpr int ranges = 128, speeds = 9;
  /// One entry of the table.
  struct Node {
    double alpha, root_beta, root_gamma;  // gain for y = [alpha, root_beta^2, root_gamma^3]
    Sigma sigma;                          // error and rate are multiplied by the range
  };
  std::array<std::array<Node, speeds>, ranges> node;
  double log2_range_min = 0, nodes_per_octave = 0, nodes_per_speed = 0;
};

/// The fixed gain of the classical filter, and the covariance of this filter for measurement noise of PSD 1.
struct LowPass {
  Gain gain;
  Covariance noise;  // for a PSD of 1 rad^2 s: ee [rad^2], ew [rad^2/s], ww [rad^2/s^2]
};

/// The settings and what follows from them; made once, at start-up.
struct Design {
  Settings settings;
  bool equal_noise = true;  // true: of each pair of tables only `pitch` is computed
  Planes<PBarTable> p_bar;
  Planes<CombinedTable> combined;
  LowPass low_pass;
};

/// Computes the tables of settings.algorithm. Call it at start-up: for `combined` it solves thousands of
/// cubic equations. Noise, jerk density, sample period, bandwidth and the ends of the tables must be
/// positive.
Design make_design(const Settings& settings);

/// The range [m] below which guidance must hold its command; transition and gain use this value for any
/// smaller range.
double least_range(const Settings& settings, double closing_speed);

/// The steady continuous-time covariance of x in the algorithm's own model. A coast begins with this P, and
/// so does a Kalman update that follows a closed gain. Solves the equations at each call.
Covariance steady_covariance(const Settings& settings, const Noise& noise, Geometry at);

/// P-bar at a closing speed [m/s], by cubic interpolation, clamped to the table.
Covariance thermal_p_bar(const PBarTable& table, double closing_speed);
/// P of x for thermal noise: each element of P-bar (Na and Lee, eqs. (6)-(8)) times a power of r.
Covariance thermal_covariance(const Covariance& p_bar, double range);
/// K for thermal noise, eq. (9) corrected: K3 = P3bar/(s2 r^2), not P3bar/(s2 r^3).
Gain thermal_gain(const Covariance& p_bar, double psd, double range);
/// P of x for glint, eq. (10) corrected: P4 = vc^2 P1bar/r^4 + 2 vc P2bar/r^3 + P4bar/r^2.
Covariance glint_covariance(const Covariance& p_bar, Geometry at);
/// K for glint, eq. (11) corrected: K3 = r P3bar/s2, not P3bar/(r s2).
Gain glint_gain(const Covariance& p_bar, double psd, Geometry at);

/// The gain of the switched tables for one sample: thermal above the crossing range, glint below.
ClosedGain closed_gain(const PBarTable& table, const Settings& settings, Geometry at);
/// The gain of the combined table for one sample, by bilinear interpolation.
ClosedGain closed_gain(const CombinedTable& table, Geometry at);
/// The fixed gain; its sigmas include only measurement noise, with the variance R = sample_variance().
ClosedGain closed_gain(const LowPass& filter, double R, double Ts);

/// Evaluates function(plane) for pitch; evaluates it for yaw only if the noise of yaw differs from that of
/// pitch. `plane` is a function that selects the member pitch or yaw of a pair.
template <class Function>
auto of_planes(const Design& design, Function function) {
  auto pitch = function([](auto& pair) -> auto& { return pair.pitch; });
  return Planes<decltype(pitch)>{
      pitch, design.equal_noise ? pitch : function([](auto& pair) -> auto& { return pair.yaw; })};
}

}  // namespace canhil::los_rate
