// The heading of a ship by Nomoto's first-order model (Nomoto et al. 1957), which describes a car at constant
// speed on small steering angles too. With the rudder angle d and the turn rate r about down:
//   T dr/dt = K d - r + T gust(t),   d(heading)/dt = r.
// The actuator follows the command d_c with a first-order lag, limits of its rate and a stop:
//   dd/dt = clamp((clamp(d_c, stop) - d) / lag, rate).
// The gust is an angular acceleration (1 - cos)/2 over its time. The speed over ground is constant and has
// the direction of the heading. The method is fourth-order Runge-Kutta with steps of at most 1 ms.
#include "bench/plant/steered_heading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

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
  double gust = 0;           ///< largest angular acceleration of the gust [rad/s^2]
  std::optional<std::pair<std::int64_t, std::int64_t>> gust_us{};
};

// The elements of the state: heading, turn rate, rudder.
using State = std::array<double, 3>;

State plus(const State& x, double dt, const State& rate) {
  return {x[0] + dt * rate[0], x[1] + dt * rate[1], x[2] + dt * rate[2]};
}

class SteeredHeading final : public Plant {
 public:
  explicit SteeredHeading(const Settings& settings) : settings_(settings), x_{settings.heading, 0, 0} {
    show();
  }

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }
  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    constexpr std::int64_t longest_us = 1000;
    const double wanted = std::clamp(inputs.front(), -settings_.stop, settings_.stop);
    const std::int64_t steps = (to_us - from_us + longest_us - 1) / longest_us;
    const double dt = 1e-6 * static_cast<double>(to_us - from_us) / static_cast<double>(steps);
    for (std::int64_t i = 0; i < steps; ++i)
      x_ = advanced(1e-6 * static_cast<double>(from_us) + static_cast<double>(i) * dt, dt, wanted);
    show();
    return {};
  }

 private:
  [[nodiscard]] double gust(double t) const {
    if (!settings_.gust_us) return 0;
    const double from = 1e-6 * static_cast<double>(settings_.gust_us->first);
    const double to = 1e-6 * static_cast<double>(settings_.gust_us->second);
    if (t <= from || t >= to) return 0;
    return settings_.gust * (1 - std::cos(2 * std::numbers::pi * (t - from) / (to - from))) / 2;
  }
  [[nodiscard]] State derivative(double t, const State& x, double wanted) const {
    const double moving = settings_.lag > 0 ? std::clamp((wanted - x[2]) / settings_.lag,
                                                         -settings_.rate_limit, settings_.rate_limit)
                                            : 0;
    return {x[1], (settings_.gain * x[2] - x[1]) / settings_.time_constant + gust(t), moving};
  }
  [[nodiscard]] State advanced(double t, double dt, double wanted) const {
    State x = x_;
    if (settings_.lag <= 0)
      x[2] += std::clamp(wanted - x[2], -settings_.rate_limit * dt, settings_.rate_limit * dt);
    const State k1 = derivative(t, x, wanted);
    const State k2 = derivative(t + dt / 2, plus(x, dt / 2, k1), wanted);
    const State k3 = derivative(t + dt / 2, plus(x, dt / 2, k2), wanted);
    const State k4 = derivative(t + dt, plus(x, dt, k3), wanted);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return x;
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
  own.rate_limit =
      section.number({"actuator_rate_degps", "Largest rate of the actuator."}, Limits::above(0), 1000);
  own.stop =
      section.number({"actuator_stop_deg", "Largest angle of the actuator."}, Limits::above(0, 90), 35);
  own.gust_us = section.optional_interval_us({"gust_s", "Begin and end of a gust."}, Limits::at_least(0));
  if (own.gust_us)
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
