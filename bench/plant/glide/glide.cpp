#include "bench/plant/glide/glide.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "bench/plant/glide/atmosphere.hpp"
#include "bench/world/units.hpp"

namespace canhil::plant::glide {
namespace {

namespace units = world::units;
using world::Euler;

constexpr int position_at = 0;
constexpr int velocity_at = 3;
constexpr int quaternion_at = 6;
constexpr int rates_at = 10;
constexpr int fins_at = 13;
constexpr int integral_at = 16;

template <class State>
Vector3 three(const State& x, int at) {
  return x.template segment<3>(at);
}

template <class State>
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

}  // namespace

// The gusts at the ends of a step.
struct Glider::Gust {
  Vector3 before, after;
};

double Glider::height_of(const State& x) const { return settings_.height - x(position_at + 2); }

Glider::State Glider::derivative(const State& x, double share, const Gust& of) const {
  static const Matrix3 I = inertia();
  static const Matrix3 I_inverse = I.inverse();
  const double height = height_of(x);
  const Matrix3 C_bn = attitude(x).normalized().toRotationMatrix();
  const Vector3 omega = three(x, rates_at);
  const Fins fins = three(x, fins_at);
  const Vector3 gust = (1 - share) * of.before + share * of.after;
  const Vector3 v_a = C_bn.transpose() * (three(x, velocity_at) - settings_.wind.at(height) - gust);
  Air air = standard_air(height);
  air.density *= 1 + settings_.density_error;
  const Loads acting = loads(v_a, omega, fins, air, errors_.now());
  const Euler angles = world::euler_from(C_bn);

  State rate;
  rate.segment<3>(position_at) = three(x, velocity_at);
  rate.segment<3>(velocity_at) = C_bn * acting.force / mass + Vector3(0, 0, units::standard_gravity);
  const Eigen::Quaterniond spin(0, omega.x(), omega.y(), omega.z());
  const Eigen::Quaterniond turning = attitude(x) * spin;  // q' = q (0, omega) / 2
  rate.segment<4>(quaternion_at) << 0.5 * turning.w(), 0.5 * turning.vec();
  rate.segment<3>(rates_at) = I_inverse * (acting.moment - omega.cross(I * omega));
  rate.segment<3>(fins_at) = (commanded(angles, omega, x(integral_at)) - fins) / fin_lag;
  rate(integral_at) = angles.pitch;
  return rate;
}

Glider::State Glider::advanced(double dt, const Gust& gust) const {
  const State& x = x_;
  const State k1 = derivative(x, 0, gust);
  const State k2 = derivative(x + dt / 2 * k1, 0.5, gust);
  const State k3 = derivative(x + dt / 2 * k2, 0.5, gust);
  const State k4 = derivative(x + dt * k3, 1, gust);
  State next = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  next.segment<4>(quaternion_at).normalize();
  return next;
}

// Whether the state is finite, the glider is above the ground, and its speed over ground is below 1000 m/s.
bool Glider::flies(const State& x) const {
  constexpr double fastest = 1000;  // [m/s]
  return x.allFinite() && three(x, velocity_at).norm() < fastest && height_of(x) > 0;
}

Glider::Glider(const Settings& settings, Stream coefficients, Stream gusts)
    : settings_(settings),
      errors_(settings.coefficients, coefficients),
      gusts_(settings.gusts, gusts),
      x_(State::Zero()) {
  x_.segment<3>(velocity_at) =
      settings.speed * Vector3(std::cos(settings.heading), std::sin(settings.heading), 0) +
      settings.wind.at(settings.height) + gusts_.now();
  x_(quaternion_at) = std::cos(settings.heading / 2);
  x_(quaternion_at + 3) = std::sin(settings.heading / 2);
  show(0);
}

Result<void> Glider::step(std::int64_t from_us, std::int64_t to_us, std::span<const double> /*inputs*/) {
  const double dt = 1e-6 * static_cast<double>(to_us - from_us);
  const Vector3 before = gusts_.now();
  gusts_.advance(dt);
  const State next = advanced(dt, {.before = before, .after = gusts_.now()});
  if (!flies(next))
    return failure(fmt::format("the glide ends at t={:.3f} s, at a height of {:.0f} m",
                               1e-6 * static_cast<double>(from_us), now_.height));
  x_ = next;
  errors_.advance(to_us, to_us - from_us);
  show(to_us);
  return {};
}

void Glider::show(std::int64_t t_us) {
  now_ = {.t_us = t_us,
          .position_n = three(x_, position_at),
          .height = height_of(x_),
          .v_eb_n = three(x_, velocity_at),
          .C_bn = attitude(x_).toRotationMatrix(),
          .omega_nb_b = three(x_, rates_at),
          .fins = three(x_, fins_at)};
  now_.wind_n = settings_.wind.at(now_.height) + gusts_.now();
  now_.v_a = now_.C_bn.transpose() * (now_.v_eb_n - now_.wind_n);
  const Euler angles = world::euler_from(now_.C_bn);
  const Vector3 v_a_n = now_.C_bn * now_.v_a;
  outputs_ = {angles.roll,     angles.pitch,  angles.heading,      now_.v_eb_n.x(),     now_.v_eb_n.y(),
              now_.v_eb_n.z(), now_.height,   now_.omega_nb_b.x(), now_.omega_nb_b.y(), now_.omega_nb_b.z(),
              now_.fins.x(),   now_.fins.y(), now_.fins.z(),       now_.wind_n.x(),     now_.wind_n.y(),
              now_.wind_n.z(), now_.v_a.x(),  now_.v_a.y(),        now_.v_a.z(),        v_a_n.x(),
              v_a_n.y(),       v_a_n.z()};
}

// An output holds its value until the next step, at which its sensors measure it.
GliderPlan::GliderPlan(const Settings& settings) : settings_(settings) {
  const auto add = [this](std::string_view of, std::initializer_list<std::string_view> names, const char* si,
                          bool turns = false) {
    for (const std::string_view name : names)
      outputs.push_back({.name = fmt::format("{}{}", of, name), .si = si, .turns = turns, .steps = true});
  };
  add("attitude.", {"roll", "pitch", "heading"}, "rad", true);
  add("velocity.", {"north", "east", "down"}, "m/s");
  add("height", {""}, "m");
  add("body_rate.", {"x", "y", "z"}, "rad/s");
  add("fins.", {"elevator", "aileron", "rudder"}, "rad");
  add("wind.", {"north", "east", "down"}, "m/s");
  add("air_velocity.", {"x", "y", "z", "north", "east", "down"}, "m/s");
  step_us = Glider::step_us;
  flown_ahead = true;
}

Result<std::unique_ptr<Plant>> GliderPlan::make(const Draw& draw) const {
  const auto stream = [&](std::string_view name) { return Stream(draw.seed, draw.run_index, name); };
  return std::make_unique<Glider>(settings_, stream("glide.coefficients"), stream("glide.gusts"));
}

}  // namespace canhil::plant::glide
