// A rigid rotorcraft over a flat Earth with constant gravity g, in the axes north, east, down (n) and
// forward, right, down (b), as in Mahony, Kumar and Corke, "Multirotor Aerial Vehicles" (2012):
//   d(position)/dt = v
//   dv/dt = C_bn (0, 0, -T) + (0, 0, g) - D (v - wind(t))
//   dq/dt = q (0, w) / 2, the quaternion of C_bn
// The inputs are what a flight controller with an inner rate loop takes (thrust and body rates). The loop and
// the motors follow the commands T_c and w_c with first-order lags; each axis has a largest angular
// acceleration, which stands for the largest moment:
//   dT/dt = (clamp(T_c, 0, T_max) - T) / lag_T
//   dw/dt = clamp((clamp(w_c, w_max) - w) / lag_w, a_max).
// T is a specific force, D the drag per mass, the same in all directions. There is no ground: a rotorcraft
// that falls goes on falling. Fourth-order Runge-Kutta with steps of at most 1 ms.
#include "bench/plant/hover.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "bench/plant/gust.hpp"
#include "bench/plant/integration.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/units.hpp"

namespace canhil::plant {
namespace {

using scenario::Limits;
using world::Vector3;

constexpr double gravity = world::units::standard_gravity;

struct HoverSettings {
  double heading = 0;                      ///< at the start [rad]
  double most_thrust = 0, thrust_lag = 0;  ///< [m/s^2], [s]
  double most_rate = 0, rate_lag = 0;      ///< [rad/s], [s]
  double most_angular_acceleration = 0;    ///< [rad/s^2]
  double drag = 0;                         ///< [1/s]
  Vector3 wind = Vector3::Zero();          ///< towards north, east, down [m/s]
  Vector3 gust_most = Vector3::Zero();     ///< added to the wind at the height of the gust
  Gust gust{};
};

// Parts of the state: position, velocity, quaternion (w, x, y, z), body rates, thrust.
using HoverState = Eigen::Matrix<double, 14, 1>;
constexpr int position_at = 0, velocity_at = 3, quaternion_at = 6, rates_at = 10, thrust_at = 13;

Eigen::Quaterniond quaternion_of(const HoverState& x) {
  const auto q = x.segment<4>(quaternion_at);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

class Hover final : public Plant {
 public:
  explicit Hover(const HoverSettings& settings) : settings_(settings) {
    const Eigen::Quaterniond q(world::C_bn_from({.heading = settings.heading}));
    x_.segment<4>(quaternion_at) << q.w(), q.x(), q.y(), q.z();
    x_[thrust_at] = std::min(gravity, settings.most_thrust);
    show();
  }

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    const double thrust = std::clamp(inputs[0], 0.0, settings_.most_thrust);
    const Vector3 rates =
        Vector3(inputs[1], inputs[2], inputs[3]).cwiseMax(-settings_.most_rate).cwiseMin(settings_.most_rate);
    in_short_steps(from_us, to_us, [&](double begin, double dt) {
      x_ = runge_kutta(x_, begin, dt,
                       [&](double t, const HoverState& x) { return derivative(t, x, thrust, rates); });
      x_.segment<4>(quaternion_at).normalize();
    });
    show();
    return {};
  }

 private:
  [[nodiscard]] HoverState derivative(double t, const HoverState& x, double thrust,
                                      const Vector3& rates) const {
    const Vector3 velocity = x.segment<3>(velocity_at), w = x.segment<3>(rates_at);
    const Vector3 wind = settings_.wind + settings_.gust.at(t) * settings_.gust_most;
    const auto q = x.segment<4>(quaternion_at);
    const Vector3 vector = q.tail<3>();
    const double most = settings_.most_angular_acceleration;
    HoverState change;
    change.segment<3>(position_at) = velocity;
    change.segment<3>(velocity_at) = quaternion_of(x) * Vector3(0, 0, -x[thrust_at]) +
                                     Vector3(0, 0, gravity) - settings_.drag * (velocity - wind);
    change[quaternion_at] = -vector.dot(w) / 2;
    change.segment<3>(quaternion_at + 1) = (q[0] * w + vector.cross(w)) / 2;
    change.segment<3>(rates_at) = ((rates - w) / settings_.rate_lag).cwiseMax(-most).cwiseMin(most);
    change[thrust_at] = (thrust - x[thrust_at]) / settings_.thrust_lag;
    return change;
  }
  void show() {
    const world::Euler angles = world::euler_from(quaternion_of(x_).toRotationMatrix());
    outputs_ = {angles.roll, angles.pitch, angles.heading, x_[3],  x_[4],  x_[5],        x_[0],
                x_[1],       x_[2],        x_[10],         x_[11], x_[12], x_[thrust_at]};
  }

  HoverSettings settings_;
  HoverState x_ = HoverState::Zero();
  std::array<double, 13> outputs_{};
};

class HoverPlan final : public Plan {
 public:
  explicit HoverPlan(const HoverSettings& settings) : settings_(settings) {
    const Variable roll_rate{.name = "roll_rate", .si = "rad/s"},
        pitch_rate{.name = "pitch_rate", .si = "rad/s"}, yaw_rate{.name = "yaw_rate", .si = "rad/s"};
    inputs = {{.name = "thrust", .si = "m/s^2", .start = gravity}, roll_rate, pitch_rate, yaw_rate};
    outputs = {{.name = "attitude.roll", .si = "rad", .turns = true},
               {.name = "attitude.pitch", .si = "rad", .turns = true},
               {.name = "attitude.heading", .si = "rad", .turns = true},
               {.name = "velocity.north", .si = "m/s"},
               {.name = "velocity.east", .si = "m/s"},
               {.name = "velocity.down", .si = "m/s"},
               {.name = "north", .si = "m"},
               {.name = "east", .si = "m"},
               {.name = "down", .si = "m"},
               roll_rate,
               pitch_rate,
               yaw_rate,
               {.name = "thrust", .si = "m/s^2"}};
  }
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& /*draw*/) const override {
    return std::make_unique<Hover>(settings_);
  }

 private:
  HoverSettings settings_;
};

// A lag that the steps of 1 ms resolve.
double read_lag(scenario::Section& section, const scenario::Key& key, double usual_s) {
  return section.number(key, Limits::between(0.005, 10), usual_s);
}

Vector3 read_gust(scenario::Section& section, Gust& gust) {
  constexpr std::array names{"gust_north_mps", "gust_east_mps", "gust_down_mps"};
  gust.us = section.optional_interval_us({"gust_s", "Begin and end of a gust."}, Limits::at_least(0));
  Vector3 most = Vector3::Zero();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (gust.us)
      most[static_cast<Eigen::Index>(i)] = section.number(
          {names[i], "Largest velocity of the air in the gust, added to the wind."}, Limits{}, 0);
    else
      section.refuse(names[i], "has no time", "gust_s beside it");
  }
  return most;
}

std::unique_ptr<Plan> read_hover(scenario::Section& section) {
  HoverSettings own;
  own.heading = section.number({"heading_deg", "Heading at the start."}, Limits::between(-180, 360), 0);
  own.most_thrust = section.number({"thrust_limit_mps2", "Largest thrust per mass; the smallest is 0."},
                                   Limits::above(0), 20);
  own.thrust_lag = read_lag(section, {"thrust_lag_s", "Time constant of the thrust after a command."}, 0.05);
  own.most_rate = section.number({"rate_limit_degps", "Largest rate of each body axis that is obeyed."},
                                 Limits::above(0), 200);
  own.rate_lag = read_lag(section, {"rate_lag_s", "Time constant of the body rates after a command."}, 0.05);
  own.most_angular_acceleration =
      section.number({"angular_acceleration_limit_degps2", "Largest angular acceleration of each body axis."},
                     Limits::above(0), 2000);
  own.drag = section.number(
      {"drag_per_s", "Drag per mass and velocity through the air, the same in all directions."},
      Limits::between(0, 100), 0.3);
  own.wind.x() = section.number({"wind_north_mps", "Velocity of the air towards north."}, Limits{}, 0);
  own.wind.y() = section.number({"wind_east_mps", "Velocity of the air towards east."}, Limits{}, 0);
  own.gust_most = read_gust(section, own.gust);
  return std::make_unique<HoverPlan>(own);
}

}  // namespace

constinit const Kind hover{
    .key = "hover",
    .meaning =
        "A small rotorcraft in the air, which thrust and body rates steer; it starts level and at rest, "
        "and there is no ground.",
    .read = read_hover};

}  // namespace canhil::plant
