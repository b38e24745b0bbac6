#include "bench/plant/engagement/engagement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::plant::engagement {
namespace {

constexpr std::int64_t longest_step_us = 1000;

// Offsets in the state vector.
constexpr int relative = 0, missile = 3, target = 6, achieved = 9, attitude = 12, turned = 16,
              accelerated = 19;

using Quaternion = Eigen::Quaterniond;

template <class State>
Quaternion quaternion_of(const State& state) {
  return Quaternion(state.template segment<4>(attitude)).normalized();
}

Planes<double> error_angles(const Vector3& los_a) {
  return {.pitch = std::atan2(-los_a.z(), los_a.x()), .yaw = std::atan2(los_a.y(), los_a.x())};
}

// Rate vector of the line of sight, without rotation about the line of sight itself: omega = r x v / r^2.
Vector3 los_rate(const Vector3& r, const Vector3& v) { return r.cross(v) / r.squaredNorm(); }

double side(Stream& stream) { return stream.uniform() < 0.5 ? -1.0 : 1.0; }

}  // namespace

Engagement::Engagement(const Settings& settings, Stream stream) : settings_(settings) {
  // Takes ten numbers from the stream, whatever the settings are.
  const Planes<double> heading{.pitch = stream.normal(), .yaw = stream.normal()};
  const Planes<double> pointing{.pitch = stream.normal(), .yaw = stream.normal()};
  const Planes<double> sides{.pitch = side(stream), .yaw = side(stream)};
  const Planes<double> heading_sides{.pitch = side(stream), .yaw = side(stream)};
  phase_ = {.pitch = 2 * std::numbers::pi * stream.uniform(), .yaw = 2 * std::numbers::pi * stream.uniform()};

  const double in_pitch = settings.planes == ActivePlanes::yaw ? 0 : 1;
  const double in_yaw = settings.planes == ActivePlanes::pitch ? 0 : 1;
  const auto angle = [&](double drawn, double to_side) {
    return settings.heading_error_sigma * drawn + settings.heading_error * to_side;
  };
  const Matrix3 C_missile = world::C_bn_from({.roll = 0,
                                              .pitch = in_pitch * angle(heading.pitch, heading_sides.pitch),
                                              .heading = in_yaw * angle(heading.yaw, heading_sides.yaw)});
  state_.segment<3>(relative) = settings.range * Vector3::UnitX();
  state_.segment<3>(missile) = settings.missile_speed * C_missile.col(0);
  state_.segment<3>(target) = -settings.target_speed * Vector3::UnitX();
  const Matrix3 C_na = world::C_bn_from({.roll = 0,
                                         .pitch = settings.pointing_error_sigma * pointing.pitch,
                                         .heading = settings.pointing_error_sigma * pointing.yaw});
  state_.segment<4>(attitude) = Quaternion(C_na).coeffs();
  // The acceleration of the target is omega x v, and v has the direction -x. So a turn about y accelerates
  // along z, and a turn about z accelerates along y.
  if (settings.target_speed > 0)
    turn_ = settings.manoeuvre.acceleration / settings.target_speed *
            Vector3(0, in_pitch * sides.pitch, in_yaw * sides.yaw);
  look_for_manoeuvre();
}

Vector3 Engagement::target_acceleration(double t, const State& state) const {
  const Manoeuvre& manoeuvre = settings_.manoeuvre;
  if (!manoeuvring_ || manoeuvre.kind == Manoeuvre::Kind::none) return Vector3::Zero();
  const Vector3 v = state.segment<3>(target);
  if (manoeuvre.kind == Manoeuvre::Kind::step) return turn_.cross(v);
  const double angle = 2 * std::numbers::pi * t / manoeuvre.period;
  const Vector3 share(0, std::sin(angle + phase_.pitch), std::sin(angle + phase_.yaw));
  return turn_.cwiseProduct(share).cross(v);
}

// Proportional navigation. The acceleration N vc omega x v / |v| is perpendicular to the missile's velocity
// v; its size is limited.
Vector3 Engagement::navigation_law(const Vector3& omega_los_n, double closing_speed,
                                   const Vector3& v_missile) const {
  const Vector3 a = settings_.navigation_constant * closing_speed * omega_los_n.cross(v_missile.normalized());
  const double size = a.norm();
  return size > settings_.acceleration_limit ? Vector3(a * (settings_.acceleration_limit / size)) : a;
}

Vector3 Engagement::demanded(const State& state) const {
  if (settings_.guidance == Guidance::target) return held_;
  const Vector3 r = state.segment<3>(relative);
  const Vector3 v_missile = state.segment<3>(missile);
  const Vector3 v = state.segment<3>(target) - v_missile;
  return navigation_law(los_rate(r, v), -r.dot(v) / r.norm(), v_missile);
}

Engagement::State Engagement::derivative(double t, const State& state) const {
  const Quaternion q_na = quaternion_of(state);
  const Vector3 v_missile = state.segment<3>(missile);
  const Vector3 demand = demanded(state);
  // The achieved acceleration stays perpendicular to the velocity, so the speed is constant.
  const Vector3 ahead = v_missile.normalized();
  const Vector3 a_missile = state.segment<3>(achieved) - ahead * ahead.dot(state.segment<3>(achieved));
  const Planes<double> error = error_angles(q_na.conjugate() * state.segment<3>(relative));
  const Vector3 omega_na_a(settings_.roll_rate, settings_.servo_gain * error.pitch,
                           settings_.servo_gain * error.yaw);

  State rate;
  rate.segment<3>(relative) = state.segment<3>(target) - v_missile;
  rate.segment<3>(missile) = a_missile;
  rate.segment<3>(target) = target_acceleration(t, state);
  rate.segment<3>(achieved) = (demand - state.segment<3>(achieved)) / settings_.autopilot_lag;
  rate.segment<4>(attitude) =
      0.5 * (q_na * Quaternion(0, omega_na_a.x(), omega_na_a.y(), omega_na_a.z())).coeffs();
  rate.segment<3>(turned) = omega_na_a;
  rate.segment<3>(accelerated) = q_na.conjugate() * a_missile;
  return rate;
}

void Engagement::step(std::int64_t dt_us) {
  const double t = 1e-6 * static_cast<double>(t_us_);
  const double dt = 1e-6 * static_cast<double>(dt_us);
  const State k1 = derivative(t, state_);
  const State k2 = derivative(t + dt / 2, state_ + dt / 2 * k1);
  const State k3 = derivative(t + dt / 2, state_ + dt / 2 * k2);
  const State k4 = derivative(t + dt, state_ + dt * k3);
  state_ += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  state_.segment<4>(attitude).normalize();
  t_us_ += dt_us;
  look_for_manoeuvre();
}

void Engagement::look_for_manoeuvre() {
  const Vector3 r = state_.segment<3>(relative);
  const Vector3 v = state_.segment<3>(target) - state_.segment<3>(missile);
  const Manoeuvre& manoeuvre = settings_.manoeuvre;
  const bool begins = manoeuvre.at_time_to_go ? r.squaredNorm() <= *manoeuvre.at_time_to_go * -r.dot(v)
                                              : 1e-6 * static_cast<double>(t_us_) >= manoeuvre.from_s;
  manoeuvring_ = manoeuvring_ || begins;
}

void Engagement::fly_to(std::int64_t t_us) {
  while (t_us_ < t_us && !over()) {
    while (!commands_.empty() && commands_.front().from_us <= t_us_) {
      const Command& next = commands_.front();
      held_ = navigation_law(next.omega_los_n, next.closing_speed, state_.segment<3>(missile));
      commands_.pop_front();
    }
    const Vector3 r = state_.segment<3>(relative);
    const Vector3 v = state_.segment<3>(target) - state_.segment<3>(missile);
    const double closing = -r.dot(v);
    std::int64_t end_us = std::min(t_us, t_us_ + longest_step_us);
    if (!commands_.empty()) end_us = std::min(end_us, commands_.front().from_us);
    // The last step extrapolates along a straight line to the closest approach. At an acceleration of 35 g,
    // the true path deviates by only 0.2 mm from this line. No integration step would be short enough here,
    // because the LOS turns too fast.
    const double to_approach = closing / v.squaredNorm();
    if (to_approach <= 1e-6 * static_cast<double>(end_us - t_us_)) {
      miss_n_ = r + v * std::max(to_approach, 0.0);
      state_.segment<3>(relative) = *miss_n_;
      t_us_ += std::llround(1e6 * std::max(to_approach, 0.0));
      return;
    }
    step(end_us - t_us_);
  }
}

bool Engagement::command(std::int64_t from_us, const Vector3& omega_los_n, double closing_speed) {
  commands_.push_back({from_us, omega_los_n, closing_speed});
  return from_us >= t_us_;
}

Truth Engagement::truth() const {
  const Quaternion q_na = quaternion_of(state_);
  const Quaternion q_an = q_na.conjugate();
  Truth now;
  now.t_us = t_us_;
  now.relative_n = state_.segment<3>(relative);
  now.velocity_n = state_.segment<3>(target) - state_.segment<3>(missile);
  now.omega_los_n = los_rate(now.relative_n, now.velocity_n);
  now.q_na = q_na;
  now.range = now.relative_n.norm();
  now.closing_speed = -now.relative_n.dot(now.velocity_n) / now.range;
  now.error = error_angles(q_an * now.relative_n);
  const Vector3 omega_a = q_an * now.omega_los_n;
  now.los_rate = {.pitch = omega_a.y(), .yaw = omega_a.z()};
  const Vector3 target_a = q_an * target_acceleration(1e-6 * static_cast<double>(t_us_), state_);
  now.target = {.pitch = target_a.z(), .yaw = target_a.y()};
  const Vector3 ahead = Vector3(state_.segment<3>(missile)).normalized();
  const Vector3 a_missile = state_.segment<3>(achieved) - ahead * ahead.dot(state_.segment<3>(achieved));
  const Vector3 missile_a = q_an * a_missile;
  now.missile = {.pitch = missile_a.z(), .yaw = missile_a.y()};
  return now;
}

Increment Engagement::take_increment() {
  Increment increment{.interval_us = t_us_ - taken_us_,
                      .delta_theta = state_.segment<3>(turned),
                      .delta_v = state_.segment<3>(accelerated)};
  state_.segment<6>(turned).setZero();
  taken_us_ = t_us_;
  return increment;
}

}  // namespace canhil::plant::engagement
