// One flight of an engagement. In this file, 'target' is the object that the missile flies to.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "bench/plant/engagement/settings.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/stream.hpp"

namespace canhil::plant::engagement {

using world::Matrix3;
using world::Planes;
using world::Stream;
using world::Vector3;

/// The truth at one instant. Angles and rates are in the axes of the antenna.
struct Truth {
  std::int64_t t_us = 0;
  double range = 0;                       ///< [m]
  double closing_speed = 0;               ///< -d(range)/dt [m/s]
  Planes<double> error{};                 ///< LOS relative to the antenna's axis [rad]
  Planes<double> los_rate{};              ///< inertial, about y and z [rad/s]
  Planes<double> target{};                ///< target acceleration along z (pitch) and y (yaw) [m/s^2]
  Planes<double> missile{};               ///< missile acceleration along z and y [m/s^2]
  Vector3 relative_n = Vector3::Zero();   ///< target position relative to the missile [m]
  Vector3 velocity_n = Vector3::Zero();   ///< target velocity relative to the missile [m/s]
  Vector3 omega_los_n = Vector3::Zero();  ///< rate vector, perpendicular to the line of sight [rad/s]
  Eigen::Quaterniond q_na = Eigen::Quaterniond::Identity();  ///< from antenna axes to n

  /// Time to the closest approach [s] if missile and target no longer accelerate. Except in the last metres,
  /// this time equals range over closing speed.
  [[nodiscard]] double time_to_go() const { return range * closing_speed / velocity_n.squaredNorm(); }
};

/// The integrals of the antenna's gyros and of the missile's accelerometers over an interval, in the
/// antenna's axes.
struct Increment {
  std::int64_t interval_us = 0;
  Vector3 delta_theta = Vector3::Zero();  ///< inertial rotation of the antenna: roll, pitch, yaw [rad]
  Vector3 delta_v = Vector3::Zero();      ///< of the missile [m/s]
};

class Engagement {
 public:
  Engagement(const Settings& settings, Stream stream);

  /// Flies to a time [us] or to the closest approach. The method is fourth-order Runge-Kutta with steps of at
  /// most 1 ms.
  void fly_to(std::int64_t t_us);

  /// Commands the acceleration N vc omega x v / |v|, where omega is the LOS rate in axes n [rad/s], vc is the
  /// closing speed [m/s] and v is the velocity of the missile. The acceleration is held from the time from_us
  /// until the next command takes effect. Commands must be in order of time. Returns false if the flight has
  /// already passed from_us; then the command takes effect at once.
  bool command(std::int64_t from_us, const Vector3& omega_los_n, double closing_speed);

  [[nodiscard]] Truth truth() const;
  /// The integrals since the last call.
  Increment take_increment();

  [[nodiscard]] bool over() const { return miss_n_.has_value(); }
  /// The position of the target relative to the missile at the closest approach [m]. None: the flight has not
  /// reached the closest approach yet.
  [[nodiscard]] const std::optional<Vector3>& miss_n() const { return miss_n_; }
  [[nodiscard]] std::int64_t t_us() const { return t_us_; }

 private:
  // Relative position, velocities of missile and target, achieved acceleration of the missile, attitude C_na
  // as a quaternion (x, y, z, w), integrals of antenna rate and acceleration in the antenna's axes.
  using State = Eigen::Matrix<double, 22, 1>;
  struct Command {
    std::int64_t from_us;
    Vector3 omega_los_n;
    double closing_speed;
  };

  [[nodiscard]] State derivative(double t, const State& state) const;
  [[nodiscard]] Vector3 demanded(const State& state) const;
  [[nodiscard]] Vector3 navigation_law(const Vector3& omega_los_n, double closing_speed,
                                       const Vector3& v_missile) const;
  [[nodiscard]] Vector3 target_acceleration(double t, const State& state) const;
  void step(std::int64_t dt_us);
  void look_for_manoeuvre();

  Settings settings_;
  State state_ = State::Zero();
  std::int64_t t_us_ = 0;
  std::int64_t taken_us_ = 0;  // end of the last increment
  bool manoeuvring_ = false;
  Vector3 turn_ = Vector3::Zero();  // turn rate of the target's velocity at full manoeuvre [rad/s]
  Planes<double> phase_{};          // phases of the target's weave [rad]
  std::deque<Command> commands_;    // not yet effective
  Vector3 held_ = Vector3::Zero();  // commanded acceleration, n [m/s^2]
  std::optional<Vector3> miss_n_;
};

}  // namespace canhil::plant::engagement
