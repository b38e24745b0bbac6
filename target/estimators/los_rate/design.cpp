#include "target/estimators/los_rate/design.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::los_rate {
namespace {

constexpr double table_range_min = 20;  // [m]; least_range() is never smaller

double psd(double sigma, double Ts) { return sigma * sigma * Ts; }

PBarTable make_p_bar_table(const Settings& settings, const Noise& noise) {
  const double q = settings.jerk_density, Ts = settings.sample_period;
  PBarTable table;
  table.thermal_psd = psd(noise.thermal, Ts);
  table.crossing_range = crossing_range(noise);
  table.nodes_per_speed = (PBarTable::nodes - 1) / settings.closing_speed_max;
  for (int i = 0; i < PBarTable::nodes; ++i)
    table.thermal[static_cast<std::size_t>(i)] = riccati(q, table.thermal_psd, i / table.nodes_per_speed);
  const double glint_psd = psd(noise.glint, Ts);
  table.glint = riccati(q, glint_psd, 0);
  table.glint_gain = pole_matched(glint_gain(table.glint, glint_psd, {1, 0}), Ts);
  return table;
}

CombinedTable make_combined_table(const Settings& settings, const Noise& noise) {
  CombinedTable table;
  const double octaves = std::log2(settings.range_max / table_range_min);
  table.log2_range_min = std::log2(table_range_min);
  table.nodes_per_octave = (CombinedTable::ranges - 1) / octaves;
  table.nodes_per_speed = (CombinedTable::speeds - 1) / settings.closing_speed_max;
  for (int i = 0; i < CombinedTable::ranges; ++i) {
    for (int j = 0; j < CombinedTable::speeds; ++j) {
      const Geometry at{table_range_min * std::exp2(i / table.nodes_per_octave), j / table.nodes_per_speed};
      const SteadyState steady =
          steady_state(settings.jerk_density, displacement_noise(noise, at, settings.sample_period));
      const Sigma sigma = sigma_of(polar(steady.P, at));
      const Gain gain = pole_matched(steady.d, settings.sample_period);
      table.node[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = {
          gain.e,
          std::sqrt(gain.w),
          std::cbrt(gain.a),
          {sigma.error * at.range, sigma.rate * at.range, sigma.acceleration}};
    }
  }
  return table;
}

// The gains match the poles of s^2 + 2 zeta b s + b^2: alpha is 1 - rho^2, and beta is
// 1 + rho^2 - 2 rho cos(theta). The steady covariance for measurement noise n of PSD 1 solves the Lyapunov
// equation of e' = w - 2 zeta b (e + n), w' = -b^2 (e + n).
LowPass make_low_pass(const Settings& settings) {
  const double b = settings.low_pass_bandwidth, zeta = settings.low_pass_damping, Ts = settings.sample_period;
  const double rho = std::exp(-zeta * b * Ts), square = 1 - zeta * zeta;
  const double theta = b * Ts * std::sqrt(std::abs(square));
  const double wave = square > 0 ? std::cos(theta) : std::cosh(theta);
  return {{1 - rho * rho, (1 + rho * rho - 2 * rho * wave) / Ts, 0},
          {.ee = b * (1 + 4 * zeta * zeta) / (4 * zeta), .ew = b * b / 2, .ww = b * b * b / (4 * zeta)}};
}

// A position in a table: the node to the left of it, and the fraction of the distance to the next node.
struct Place {
  std::size_t node;
  double share;
};
Place place(double position, int count) {
  const double x = std::clamp(position, 0.0, count - 1.0);
  const int node = std::min(static_cast<int>(x), count - 2);
  return {static_cast<std::size_t>(node), x - node};
}

CombinedTable::Node blend(const CombinedTable::Node& a, const CombinedTable::Node& b, double share) {
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  return {mix(a.alpha, b.alpha),
          mix(a.root_beta, b.root_beta),
          mix(a.root_gamma, b.root_gamma),
          {mix(a.sigma.error, b.sigma.error), mix(a.sigma.rate, b.sigma.rate),
           mix(a.sigma.acceleration, b.sigma.acceleration)}};
}

}  // namespace

Design make_design(const Settings& settings) {
  Design design;
  design.settings = settings;
  const Planes<Noise>& noise = settings.noise;
  design.equal_noise = noise.pitch == noise.yaw;
  if (settings.algorithm == Algorithm::switched_table) {
    design.p_bar.pitch = make_p_bar_table(settings, noise.pitch);
    if (!design.equal_noise) design.p_bar.yaw = make_p_bar_table(settings, noise.yaw);
  }
  if (settings.algorithm == Algorithm::combined) {
    design.combined.pitch = make_combined_table(settings, noise.pitch);
    if (!design.equal_noise) design.combined.yaw = make_combined_table(settings, noise.yaw);
  }
  design.low_pass = make_low_pass(settings);
  return design;
}

double least_range(const Settings& settings, double closing_speed) {
  return std::max({settings.blind_range, 3 * settings.range_sigma,
                   10 * closing_speed * settings.sample_period, table_range_min});
}

Covariance steady_covariance(const Settings& settings, const Noise& noise, Geometry at) {
  const double q = settings.jerk_density, Ts = settings.sample_period;
  switch (settings.algorithm) {
    case Algorithm::switched_table:
      return at.range >= crossing_range(noise)
                 ? thermal_covariance(riccati(q, psd(noise.thermal, Ts), at.closing_speed), at.range)
                 : glint_covariance(riccati(q, psd(noise.glint, Ts), 0), at);
    case Algorithm::low_pass: {
      const Covariance unit = make_low_pass(settings).noise;
      const double S = sample_variance(noise, at.range) * Ts, a = settings.acceleration_sigma_0;
      return {.ee = S * unit.ee, .ew = S * unit.ew, .ww = S * unit.ww, .aa = a * a};
    }
    case Algorithm::combined:
    case Algorithm::kalman:
      break;
  }
  return polar(steady_state(q, displacement_noise(noise, at, Ts)).P, at);
}

Covariance thermal_p_bar(const PBarTable& table, double closing_speed) {
  // Lagrange interpolation over four nodes, because P-bar is nearly a cubic function of vc.
  const Place at = place(closing_speed * table.nodes_per_speed, PBarTable::nodes);
  const std::size_t first = std::clamp<std::size_t>(at.node, 1, PBarTable::nodes - 3) - 1;
  const double t = static_cast<double>(at.node) + at.share - static_cast<double>(first);
  const double a = t * (t - 1), b = (t - 2) * (t - 3);
  const std::array weight{-(t - 1) * b / 6, t * b / 2, -a * (t - 3) / 2, a * (t - 2) / 6};
  Covariance P;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const Covariance& node = table.thermal[first + i];
    P.ee += weight[i] * node.ee;
    P.ew += weight[i] * node.ew;
    P.ea += weight[i] * node.ea;
    P.ww += weight[i] * node.ww;
    P.wa += weight[i] * node.wa;
    P.aa += weight[i] * node.aa;
  }
  return P;
}

Covariance thermal_covariance(const Covariance& p_bar, double r) {
  const double r2 = r * r;
  return {r2 * r * p_bar.ee, r2 * p_bar.ew, r2 * p_bar.ea, r * p_bar.ww, r * p_bar.wa, r * p_bar.aa};
}

Gain thermal_gain(const Covariance& p_bar, double psd, double r) {
  const double u = 1 / (psd * r);
  return {u * p_bar.ee, u / r * p_bar.ew, u / r * p_bar.ea};
}

Covariance glint_covariance(const Covariance& p_bar, Geometry at) { return polar(p_bar, at); }

Gain glint_gain(const Covariance& p_bar, double psd, Geometry at) {
  return polar(Gain{p_bar.ee / psd, p_bar.ew / psd, p_bar.ea / psd}, at);
}

ClosedGain closed_gain(const PBarTable& table, const Settings& settings, Geometry at) {
  if (at.range < table.crossing_range)
    return {polar(table.glint_gain, at), sigma_of(glint_covariance(table.glint, at))};
  const Covariance p_bar = thermal_p_bar(table, at.closing_speed);
  const Gain continuous = displacement(thermal_gain(p_bar, table.thermal_psd, at.range), at);
  return {polar(pole_matched(continuous, settings.sample_period), at),
          sigma_of(thermal_covariance(p_bar, at.range))};
}

ClosedGain closed_gain(const CombinedTable& table, Geometry at) {
  const Place range =
      place((std::log2(at.range) - table.log2_range_min) * table.nodes_per_octave, CombinedTable::ranges);
  const Place speed = place(at.closing_speed * table.nodes_per_speed, CombinedTable::speeds);
  const auto& near = table.node[range.node];
  const auto& far = table.node[range.node + 1];
  const CombinedTable::Node node =
      blend(blend(near[speed.node], near[speed.node + 1], speed.share),
            blend(far[speed.node], far[speed.node + 1], speed.share), range.share);
  const double b = node.root_beta, c = node.root_gamma;
  return {polar(Gain{node.alpha, b * b, c * c * c}, at),
          {node.sigma.error / at.range, node.sigma.rate / at.range, node.sigma.acceleration}};
}

ClosedGain closed_gain(const LowPass& filter, double R, double Ts) {
  return {filter.gain, {std::sqrt(R * Ts * filter.noise.ee), std::sqrt(R * Ts * filter.noise.ww), 0}};
}

}  // namespace canhil::los_rate
