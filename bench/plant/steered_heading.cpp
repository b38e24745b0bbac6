// The heading of a ship by Nomoto's first-order model (Nomoto et al. 1957), which describes a car at constant
// speed on small steering angles too. With the rudder angle d and the turn rate r about down:
//   T dr/dt = K d - r + T gust(t),   d(heading)/dt = r.
// The actuator follows the command d_c with a first-order lag, limits of its rate and a stop:
//   dd/dt = clamp((clamp(d_c + offset, stop) - d) / lag, rate).
// The gust is an angular acceleration (1 - cos)/2 over its time. The speed over ground is constant and has
// the direction of the heading. The method is fourth-order Runge-Kutta with steps of at most 1 ms.
#include "bench/plant/steered_heading.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/plant/gust.hpp"
#include "bench/plant/integration.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/units.hpp"

namespace canhil::plant {
namespace {

using scenario::Limits;

struct Settings {
  double heading = 0;        ///< at the start [rad]
  double speed = 0;          ///< [m/s]
  double time_constant = 1;  ///< T [s]
  double gain = 1;           ///< K: turn rate per rudder angle [1/s]
  double lag = 0;            ///< of the actuator [s]; 0: none
  double rate_limit = 0;     ///< of the actuator [rad/s]
  double stop = 0;           ///< largest angle of the actuator [rad]
  double offset = 0;         ///< of the actuator's zero [rad]
  double gust = 0;           ///< largest angular acceleration of the gust [rad/s^2]
  Gust gust_time{};
};

// The elements of the state: heading, turn rate, rudder.
using State = Eigen::Vector3d;

class SteeredHeading final : public Plant {
 public:
  explicit SteeredHeading(const Settings& settings) : settings_(settings), x_{settings.heading, 0, 0} {
    show();
  }

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    const double wanted = std::clamp(inputs.front() + settings_.offset, -settings_.stop, settings_.stop);
    in_short_steps(from_us, to_us, [&](double t, double dt) { x_ = advanced(t, dt, wanted); });
    show();
    return {};
  }

 private:
  [[nodiscard]] State derivative(double t, const State& x, double wanted) const {
    const double moving = settings_.lag > 0 ? std::clamp((wanted - x[2]) / settings_.lag,
                                                         -settings_.rate_limit, settings_.rate_limit)
                                            : 0;
    const double gust = settings_.gust * settings_.gust_time.at(t);
    return {x[1], (settings_.gain * x[2] - x[1]) / settings_.time_constant + gust, moving};
  }
  [[nodiscard]] State advanced(double t, double dt, double wanted) const {
    State x = x_;
    if (settings_.lag <= 0)
      x[2] += std::clamp(wanted - x[2], -settings_.rate_limit * dt, settings_.rate_limit * dt);
    return runge_kutta(x, t, dt,
                       [&](double time, const State& state) { return derivative(time, state, wanted); });
  }
  void show() {
    outputs_ = {x_[0], settings_.speed * std::cos(x_[0]), settings_.speed * std::sin(x_[0]), x_[1], x_[2]};
  }

  Settings settings_;
  State x_;
  std::array<double, 5> outputs_{};
};

class SteeredPlan final : public Plan {
 public:
  explicit SteeredPlan(const Settings& settings) : settings_(settings) {
    inputs = {{.name = "rudder", .si = "rad"}};
    outputs = {{.name = "attitude.heading", .si = "rad", .turns = true},
               {.name = "velocity.north", .si = "m/s"},
               {.name = "velocity.east", .si = "m/s"},
               {.name = "turn_rate", .si = "rad/s"},
               {.name = "rudder", .si = "rad"}};
  }
  [[nodiscard]] Result<std::unique_ptr<Plant>> make(const Draw& /*draw*/) const override {
    return std::make_unique<SteeredHeading>(settings_);
  }

 private:
  Settings settings_;
};

std::unique_ptr<Plan> read(scenario::Section& section) {
  Settings own;
  own.heading = section.number({"heading_deg", "Heading at the start."}, Limits::between(-180, 360));
  own.speed = section.number({"speed_mps", "Speed over ground, constant, in the direction of the heading."},
                             Limits::at_least(0));
  own.time_constant =
      section.number({"turn_time_constant_s", "Time constant of the turn rate after a step of the rudder."},
                     Limits::above(0));
  own.gain =
      section.number({"turn_gain_per_s", "Turn rate in the steady state per angle of the rudder."}, Limits{});
  own.lag =
      section.number({"actuator_lag_s", "Time constant of the actuator; 0: none."}, Limits::at_least(0), 0);
  constexpr double least_lag = 0.005;  // that the steps of 1 ms resolve
  if (own.lag > 0 && own.lag < least_lag)
    section.reject("actuator_lag_s", "is too short", "0, or at least 0.005");
  own.rate_limit =
      section.number({"actuator_rate_degps", "Largest rate of the actuator."}, Limits::above(0), 1000);
  own.stop =
      section.number({"actuator_stop_deg", "Largest angle of the actuator."}, Limits::above(0, 90), 35);
  own.offset = section.number({"actuator_offset_deg", "Angle of the actuator at the command 0."},
                              Limits::between(-90, 90), 0);
  own.gust_time.us =
      section.optional_interval_us({"gust_s", "Begin and end of a gust."}, Limits::at_least(0));
  if (own.gust_time.us)
    own.gust =
        section.number({"gust_degps2", "Largest angular acceleration of the gust about down."}, Limits{});
  else
    section.refuse("gust_degps2", "has no time", "gust_s beside it");
  return std::make_unique<SteeredPlan>(own);
}

}  // namespace

constinit const Kind steered_heading{
    .key = "steered_heading",
    .meaning = "A ship or a car at constant speed, whose heading a rudder or a steering actuator turns.",
    .read = read};

}  // namespace canhil::plant
