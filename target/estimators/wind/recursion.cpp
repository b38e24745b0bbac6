#include "target/estimators/wind/recursion.hpp"

#include <algorithm>
#include <cmath>

#include "target/estimators/wind/squared.hpp"

namespace canhil::wind {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double theta_lambda_most = 0.9;  // P~ exists only for theta lambda_max < 1

Observation noise_variance(const Settings& s) {
  Observation R;
  R << Vector3d::Constant(squared(s.velocity_sigma)), Vector3d::Constant(squared(s.rate_sigma)),
      Vector3d::Constant(squared(s.attitude_sigma));
  return R;
}

// Adds to P the effect of relative coefficient errors of variance q on the air velocity and the rates.
void add_noise_of_coefficients(Covariance& P, double q, const LoadsByPart& loads, const Design& design) {
  const Eigen::Matrix<double, 3, part_count - force_part_count> turn =
      design.inertia_inverse.lazyProduct(loads.moment);
  filtering::Matrix<3, 3> of_force = loads.specific_force.lazyProduct(loads.specific_force.transpose());
  filtering::Matrix<3, 3> of_moment = turn.lazyProduct(turn.transpose());
  filtering::mirror_lower<3>(of_force);
  filtering::mirror_lower<3>(of_moment);
  P.block<3, 3>(air_velocity_at, air_velocity_at) += q * of_force;
  P.block<3, 3>(rate_at, rate_at) += q * of_moment;
}

}  // namespace

Densities raised(Densities density, const Densities& least) {
  density.air_velocity = std::max(density.air_velocity, least.air_velocity);
  density.rate = std::max(density.rate, least.rate);
  density.attitude = std::max(density.attitude, least.attitude);
  density.wind = std::max(density.wind, least.wind);
  density.coefficient = std::max(density.coefficient, least.coefficient);
  return density;
}

void predict(StateVector& x, Covariance& P, double dt, const Inputs& inputs, const Densities& density,
             const Design& design, RangeFlags& outside, Sensitivity* sensitivity) {
  const Linearisation at = linearise(x, inputs, design, outside);
  const Densities noise = outside.any() ? raised(density, design.settings.degraded) : density;
  const double q_wind = squared(noise.wind) * dt;
  StateVector Q;
  Q << Vector3d::Constant(squared(noise.air_velocity) * dt), Vector3d::Constant(squared(noise.rate) * dt),
      Vector3d::Constant(squared(noise.attitude) * dt), Vector3d::Constant(q_wind);
  const Growth G = growth(at.A, dt);
  P = predicted(P, G);
  if (design.settings.process_noise != ProcessNoise::block_diagonal) {
    // v_a' has -C_nb v_w': Q_aa += C_nb q C_bn = q I, Q_aw = -C_nb q
    const Matrix3d C_nb = C_bn(x.segment<3>(attitude_at)).transpose();
    Q.segment<3>(air_velocity_at).array() += q_wind;
    P.block<3, 3>(air_velocity_at, wind_at) -= q_wind * C_nb;
    P.block<3, 3>(wind_at, air_velocity_at) -= q_wind * C_nb.transpose();
  }
  P.diagonal() += Q;
  if (at.loads) add_noise_of_coefficients(P, squared(noise.coefficient) * dt, *at.loads, design);
  if (at.loads && sensitivity != nullptr) predict(*sensitivity, G, *at.loads, dt, design);
  x = predicted(x, at.f, dt, inputs, design, outside);
}

Observation innovation_of(const Observation& y, const StateVector& x, const GroundVelocity& at) {
  Observation nu;
  nu.head<3>() = y.head<3>() - at.C_v_a - x.segment<3>(wind_at);
  nu.tail<6>() = y.tail<6>() - x.segment<6>(rate_at);
  for (int i = 6; i < 9; ++i) nu(i) = wrapped(nu(i));
  return nu;
}

Answer update(StateVector& x, Covariance& P, const Observation& innovation, const GroundVelocity& at,
              double interval, const Design& design, Sensitivity* sensitivity) {
  const Settings& settings = design.settings;
  Answer answer{.innovation = innovation, .normalised = {}, .lasting = {}};
  Correction c = sensitivity == nullptr ? corrected(P, innovation, at, noise_variance(settings))
                                        : corrected(P, innovation, at, noise_variance(settings), sensitivity,
                                                    lasting_sigma(settings));
  answer.normalised = c.normalised;
  answer.lasting = c.lasting;
  answer.nis = c.nis;
  answer.surprise = c.nis + std::log(c.determinant);
  if (settings.algorithm == Algorithm::h_infinity) {
    const double theta = settings.theta_per_s * interval;
    const double cap = std::min(settings.theta_cap_per_s * interval, theta_lambda_most);
    answer.theta = capped_theta(theta, cap, c.P, settings.rate_weight);
    answer.theta_capped = answer.theta < theta;
    inflate(c, answer.theta, settings.rate_weight);
  }
  x += c.dx;
  P = c.P;
  return answer;
}

Answer update(StateVector& x, Covariance& P, const Observation& y, double interval, const Design& design) {
  const GroundVelocity at = ground_velocity(x);
  return update(x, P, innovation_of(y, x, at), at, interval, design);
}

}  // namespace canhil::wind
