// A glide that is flown, and its record as a run keeps it.
#pragma once

#include <memory>
#include <vector>

#include "bench/plant/glide/glide.hpp"
#include "bench/plant/glide/read.hpp"
#include "bench/plant/setup.hpp"
#include "bench/plant/simulation.hpp"

namespace canhil::plant::glide {

class Flown {
 public:
  explicit Flown(const Settings& settings, std::int64_t duration_us, std::uint64_t run = 0)
      : facts_(facts_of(table, std::make_shared<GliderPlan>(settings))),
        simulation_(std::move(
            *Simulation::begin(*facts_.setup, {.seed = 3, .run_index = run},
                               {.start = {}, .duration_us = duration_us, .interval_us = Glider::step_us}))) {
    simulation_->advance(duration_us);
    Glider glider(settings, Stream(3, run, "glide.coefficients"), Stream(3, run, "glide.gusts"));
    epochs_.push_back(glider.now());
    for (std::int64_t t_us = 0; t_us < duration_us; t_us += Glider::step_us) {
      if (!glider.step(t_us, t_us + Glider::step_us, {})) break;
      epochs_.push_back(glider.now());
    }
  }

  /// Every 10 ms from 0 on.
  [[nodiscard]] const std::vector<Truth>& epochs() const { return epochs_; }
  [[nodiscard]] const Truth& at(std::int64_t t_us) const {
    return epochs_[static_cast<std::size_t>(t_us / Glider::step_us)];
  }
  [[nodiscard]] std::int64_t end_us() const { return epochs_.back().t_us; }

  [[nodiscard]] const world::PlantRecord& record() const { return simulation_->record(); }
  [[nodiscard]] const Simulation& simulation() const { return *simulation_; }

 private:
  scenario::PlantFacts facts_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<Truth> epochs_;
};

}  // namespace canhil::plant::glide
