#include "bench/plant/engagement/plan.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <string_view>

namespace canhil::plant::engagement {

Missile::Missile(const Settings& settings, Stream stream) : engagement_(settings, stream) { show(); }

Result<void> Missile::step(std::int64_t /*from_us*/, std::int64_t to_us, std::span<const double> /*inputs*/) {
  engagement_.fly_to(to_us);
  show();
  return {};
}

bool Missile::guide(std::int64_t from_us, std::span<const double> inputs) {
  return engagement_.command(from_us, Vector3(inputs.data()), inputs[3]);
}

std::optional<std::int64_t> Missile::ended_us() const {
  return engagement_.over() ? std::optional(engagement_.t_us()) : std::nullopt;
}

void Missile::show() {
  const Truth now = engagement_.truth();
  const Increment last = engagement_.take_increment();
  outputs_ = {now.los_rate.pitch,   now.los_rate.yaw,     now.range,
              now.closing_speed,    now.time_to_go(),     now.error.pitch,
              now.error.yaw,        now.target.pitch,     now.target.yaw,
              now.missile.pitch,    now.missile.yaw,      now.relative_n.x(),
              now.relative_n.y(),   now.relative_n.z(),   now.q_na.w(),
              now.q_na.x(),         now.q_na.y(),         now.q_na.z(),
              last.delta_theta.x(), last.delta_theta.y(), last.delta_theta.z(),
              last.delta_v.y(),     last.delta_v.z()};
}

MissilePlan::MissilePlan(const Settings& settings) : settings_(settings) {
  const auto add = [this](std::string_view of, std::initializer_list<std::string_view> names, const char* si,
                          bool steps = false) {
    for (const std::string_view name : names)
      outputs.push_back({.name = fmt::format("{}{}", of, name), .si = si, .steps = steps});
  };
  add("los.rate.", {"pitch", "yaw"}, "rad/s");
  add("", {"range"}, "m");
  add("", {"closing_speed"}, "m/s");
  add("", {"time_to_go"}, "s");
  add("error.", {"pitch", "yaw"}, "rad");
  add("target_acceleration.", {"pitch", "yaw"}, "m/s^2");
  add("missile_acceleration.", {"pitch", "yaw"}, "m/s^2");
  add("relative.", {"x", "y", "z"}, "m");
  add("antenna.", {"w", "x", "y", "z"}, "");
  constexpr bool of_a_step = true;
  add("antenna_increment.", {"roll", "pitch", "yaw"}, "rad", of_a_step);
  add("velocity_increment.", {"y", "z"}, "m/s", of_a_step);
  inputs = {{.name = "los.rate.x", .si = "rad/s"},
            {.name = "los.rate.y", .si = "rad/s"},
            {.name = "los.rate.z", .si = "rad/s"},
            {.name = "closing_speed", .si = "m/s"}};
  step_us = 5'000;
  steps_with_sensors = true;
  never_ahead = true;
}

Result<std::unique_ptr<Plant>> MissilePlan::make(const Draw& draw) const {
  return std::make_unique<Missile>(settings_, Stream(draw.seed, draw.run_index, "engagement"));
}

}  // namespace canhil::plant::engagement
