#include "target/estimators/los_rate/lag.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::los_rate {

void note_lag(State& state, Plane innovation, const Planes<double>& K1, const Planes<double>& S,
              const Design& design) {
  if (design.settings.algorithm != Algorithm::combined) return;
  const auto lag = [&](double drift, double variance, double K) {
    constexpr double lag_per_drift = 2;
    const double noise = std::sqrt(variance * K / 2);  // of a mean with the gain K1
    return lag_per_drift * K / design.settings.sample_period * std::max(std::abs(drift) - 1.5 * noise, 0.0);
  };
  const Plane change = innovation - state.drift;
  state.drift += Plane(K1.yaw * change.real(), K1.pitch * change.imag());
  state.lag = {.pitch = lag(state.drift.imag(), S.pitch, K1.pitch),
               .yaw = lag(state.drift.real(), S.yaw, K1.yaw)};
}

Planes<Sigma> reported_sigma(const UpdateResult& result, const Design& design) {
  Planes<Sigma> sigma = result.sigma;
  const Settings& s = design.settings;
  const bool tracks = result.outcome != Outcome::waiting && result.outcome != Outcome::started;
  if (!tracks || s.algorithm != Algorithm::combined || !(result.used.range > 0)) return sigma;
  const Planes<double> lag = of_planes(design, [&](auto plane) {
    const double R_y = displacement_noise(plane(s.noise), result.used, s.sample_period).R_y;
    const double bandwidth = std::pow(s.jerk_density / R_y, 1.0 / 6);
    return 0.885 * s.acceleration_sigma_0 / (bandwidth * result.used.range);
  });
  const auto add = [&](double& rate, double usual_lag, double seen_lag) {
    rate = std::hypot(std::hypot(rate, usual_lag / 2), std::hypot(seen_lag, s.antenna_rate_bias_sigma));
  };
  add(sigma.pitch.rate, lag.pitch, result.lag.pitch);
  add(sigma.yaw.rate, lag.yaw, result.lag.yaw);
  return sigma;
}

}  // namespace canhil::los_rate
