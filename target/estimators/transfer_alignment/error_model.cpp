#include "target/estimators/transfer_alignment/error_model.hpp"

#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/transfer_alignment/invariant.hpp"

namespace canhil::transfer_alignment {

using strapdown::skew;

Covariance transition_increment(const Interval& interval) {
  const double dt = interval.duration;
  Covariance G = Covariance::Zero();
  G.block<3, 3>(velocity_state, velocity_state) = skew(-dt * (2 * interval.omega_ie_n + interval.omega_en_n));
  G.block<3, 3>(velocity_state, attitude_state) = skew(interval.delta_v_n);
  G.block<3, 3>(velocity_state, accel_bias_state) = interval.C_bn_integral;
  G.block<3, 3>(attitude_state, attitude_state) = skew(-dt * (interval.omega_ie_n + interval.omega_en_n));
  G.block<3, 3>(attitude_state, gyro_bias_state) = -interval.C_bn_integral;
  return G;
}

StateVector process_noise(const Settings& settings, double duration) {
  const double accel = settings.accel_noise_density * settings.accel_noise_density * duration;
  const double gyro = settings.gyro_noise_density * settings.gyro_noise_density * duration;
  StateVector q = StateVector::Zero();
  q.segment<3>(velocity_state).setConstant(accel);
  q.segment<3>(attitude_state).setConstant(gyro);
  return q;
}

StateVector initial_variance(const Settings& settings) {
  StateVector sigma;
  sigma << settings.velocity_sigma_0, settings.attitude_sigma_0, settings.accel_bias_sigma_0,
      settings.gyro_bias_sigma_0;
  StateVector variance = sigma.cwiseAbs2();
  if (settings.loop == Loop::invariant)
    variance.segment<2>(attitude_state) = initial_tilt_variance(variance.segment<3>(attitude_state));
  return variance;
}

}  // namespace canhil::transfer_alignment
