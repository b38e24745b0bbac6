// An engagement in a run, and what it recorded.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "bench/plant/engagement/read.hpp"
#include "bench/plant/setup.hpp"
#include "bench/plant/simulation.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::plant::engagement {

using world::Planes;
using world::Vector3;

/// The truth at a step.
struct Epoch {
  std::int64_t t_us = 0;
  double range = 0, closing_speed = 0;
  Planes<double> error{}, los_rate{}, target{}, missile{};
};

class Flown {
 public:
  explicit Flown(const Settings& settings, std::int64_t step_us = 5000, std::int64_t duration_us = 10'000'000)
      : facts_(facts_of(settings)),
        simulation_(
            std::move(*Simulation::begin(*facts_.setup, {.seed = 1, .run_index = 0, .sensors_us = step_us},
                                         {.start = {}, .duration_us = duration_us, .interval_us = 10'000}))) {
  }

  [[nodiscard]] const scenario::PlantFacts& facts() const { return facts_; }
  [[nodiscard]] Simulation& simulation() { return *simulation_; }
  [[nodiscard]] const world::PlantRecord& record() const { return simulation_->record(); }
  /// Target relative to missile at the closest approach [m]; none: not reached.
  [[nodiscard]] std::optional<Vector3> miss_n() const {
    if (!record().ended_us) return std::nullopt;
    const auto relative = world::PlantColumns<3>::find(
        {&record()}, {"plant.relative.x", "plant.relative.y", "plant.relative.z"});
    const auto miss = relative->of_row(record().times_us().size() - 1);
    return Vector3(miss.data());
  }
  /// The number of steps before the passage, without the start.
  [[nodiscard]] std::size_t epochs() const {
    return record().times_us().size() - (record().ended_us ? 2 : 1);
  }
  [[nodiscard]] Epoch epoch(std::size_t index) const {
    const auto columns = world::PlantColumns<10>::find(
        {&record()},
        {"plant.range", "plant.closing_speed", "plant.error.pitch", "plant.error.yaw", "los.rate.pitch",
         "los.rate.yaw", "plant.target_acceleration.pitch", "plant.target_acceleration.yaw",
         "plant.missile_acceleration.pitch", "plant.missile_acceleration.yaw"});
    const auto now = columns->of_row(index + 1);
    return {.t_us = record().times_us()[index + 1],
            .range = now[0],
            .closing_speed = now[1],
            .error = {.pitch = now[2], .yaw = now[3]},
            .los_rate = {.pitch = now[4], .yaw = now[5]},
            .target = {.pitch = now[6], .yaw = now[7]},
            .missile = {.pitch = now[8], .yaw = now[9]}};
  }

 private:
  scenario::PlantFacts facts_;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace canhil::plant::engagement
