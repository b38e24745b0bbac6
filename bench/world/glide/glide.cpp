#include "bench/world/glide/glide.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "bench/world/glide/atmosphere.hpp"
#include "bench/world/units.hpp"

namespace canhil::world {
namespace {

using glide::Factors;
using glide::Fins;

// The elements of the state: position, v_eb_n, quaternion (w, x, y, z), omega, fins, integral of pitch.
using State = Eigen::Matrix<double, 17, 1>;
constexpr int position_at = 0;
constexpr int velocity_at = 3;
constexpr int quaternion_at = 6;
constexpr int rates_at = 10;
constexpr int fins_at = 13;
constexpr int integral_at = 16;

Vector3 three(const State& x, int at) { return x.segment<3>(at); }

Eigen::Quaterniond attitude(const State& x) {
  return Eigen::Quaterniond(x(quaternion_at), x(quaternion_at + 1), x(quaternion_at + 2),
                            x(quaternion_at + 3));
}

constexpr double fin_lag = 0.05;  // of the actuators [s]

// Attitude hold: deflections that keep pitch and roll at zero and damp the yaw, limited to 20 degrees. A
// positive elevator pitches down, a positive rudder yaws to the left, a positive aileron rolls to the right.
// `pitch_integral`: the integral of pitch over time [rad s].
Fins commanded(const Euler& angles, const Vector3& omega, double pitch_integral) {
  constexpr double limit = 20 * units::deg;
  const Fins wanted(1.0 * angles.pitch + 0.4 * pitch_integral + 0.30 * omega.y(),
                    -0.8 * angles.roll - 0.25 * omega.x(), 0.30 * omega.z());
  return wanted.cwiseMax(-limit).cwiseMin(limit);
}

// Inputs that are constant during one step.
struct Step {
  const GlidePlan& plan;
  const Factors& factors;
  Vector3 gust_before;
  Vector3 gust_after;
};

double height_of(const State& x, const GlidePlan& plan) { return plan.height - x(position_at + 2); }

State derivative(const State& x, double share, const Step& step) {
  static const Matrix3 I = glide::inertia();
  static const Matrix3 I_inverse = I.inverse();
  const double height = height_of(x, step.plan);
  const Matrix3 C_bn = attitude(x).normalized().toRotationMatrix();
  const Vector3 omega = three(x, rates_at);
  const Fins fins = three(x, fins_at);
  const Vector3 gust = (1 - share) * step.gust_before + share * step.gust_after;
  const Vector3 v_a = C_bn.transpose() * (three(x, velocity_at) - step.plan.wind.at(height) - gust);
  glide::Air air = glide::standard_air(height);
  air.density *= 1 + step.plan.density_error;
  const glide::Loads loads = glide::loads(v_a, omega, fins, air, step.factors);
  const Euler angles = euler_from(C_bn);

  State rate;
  rate.segment<3>(position_at) = three(x, velocity_at);
  rate.segment<3>(velocity_at) = C_bn * loads.force / glide::mass + Vector3(0, 0, units::standard_gravity);
  const Eigen::Quaterniond spin(0, omega.x(), omega.y(), omega.z());
  const Eigen::Quaterniond turning = attitude(x) * spin;  // q' = q (0, omega) / 2
  rate.segment<4>(quaternion_at) << 0.5 * turning.w(), 0.5 * turning.vec();
  rate.segment<3>(rates_at) = I_inverse * (loads.moment - omega.cross(I * omega));
  rate.segment<3>(fins_at) = (commanded(angles, omega, x(integral_at)) - fins) / fin_lag;
  rate(integral_at) = angles.pitch;
  return rate;
}

State advanced(const State& x, double dt, const Step& step) {
  const State k1 = derivative(x, 0, step);
  const State k2 = derivative(x + dt / 2 * k1, 0.5, step);
  const State k3 = derivative(x + dt / 2 * k2, 0.5, step);
  const State k4 = derivative(x + dt * k3, 1, step);
  State next = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  next.segment<4>(quaternion_at).normalize();
  return next;
}

State start(const GlidePlan& plan, const Vector3& gust) {
  State x = State::Zero();
  x.segment<3>(velocity_at) = plan.speed * Vector3(std::cos(plan.heading), std::sin(plan.heading), 0) +
                              plan.wind.at(plan.height) + gust;
  x(quaternion_at) = std::cos(plan.heading / 2);
  x(quaternion_at + 3) = std::sin(plan.heading / 2);
  return x;
}

GlideTruth truth(const State& x, std::int64_t t_us, const GlidePlan& plan, const Vector3& gust) {
  GlideTruth now{.t_us = t_us,
                 .position_n = three(x, position_at),
                 .height = height_of(x, plan),
                 .v_eb_n = three(x, velocity_at),
                 .C_bn = attitude(x).toRotationMatrix(),
                 .omega_nb_b = three(x, rates_at),
                 .fins = three(x, fins_at)};
  now.wind_n = plan.wind.at(now.height) + gust;
  now.v_a = now.C_bn.transpose() * (now.v_eb_n - now.wind_n);
  return now;
}

// Whether the state is finite, the glider is above the ground, and its speed over ground is below 1000 m/s.
bool flies(const State& x, const GlidePlan& plan) {
  constexpr double fastest = 1000;  // [m/s]
  return x.allFinite() && three(x, velocity_at).norm() < fastest && height_of(x, plan) > 0;
}

}  // namespace

GlideRecord::GlideRecord(const GlidePlan& plan, std::int64_t duration_us, Stream coefficients, Stream gusts) {
  constexpr double dt = 1e-6 * static_cast<double>(step_us);
  glide::CoefficientErrors errors(plan.coefficients, coefficients);
  glide::Gusts wind(plan.gusts, gusts);
  epochs_.reserve(static_cast<std::size_t>(duration_us / step_us) + 1);
  State x = start(plan, wind.now());
  epochs_.push_back(truth(x, 0, plan, wind.now()));
  for (std::int64_t t_us = step_us; t_us <= duration_us; t_us += step_us) {
    const Vector3 before = wind.now();
    wind.advance(dt);
    x = advanced(x, dt,
                 {.plan = plan, .factors = errors.now(), .gust_before = before, .gust_after = wind.now()});
    if (!flies(x, plan)) return;
    errors.advance(t_us, step_us);
    epochs_.push_back(truth(x, t_us, plan, wind.now()));
  }
}

}  // namespace canhil::world
