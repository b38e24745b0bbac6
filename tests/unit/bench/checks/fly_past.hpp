// A fly-past, whose answers tests judge.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/world/motion/rest.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::checks {

/// What a missile flew, as a test says it.
struct Flown {
  struct Sample {
    std::int64_t t_us = 0;
    double range = 0, closing_speed = 1000;  ///< of bodies that fly straight at each other [m], [m/s]
    world::Planes<double> los_rate{};

    [[nodiscard]] double time_to_go() const { return range / closing_speed; }
  };
  std::vector<Sample> epochs{};  ///< at the times of the seeker's samples
  std::optional<world::Vector3> miss_n{};
  std::int64_t passage_us = 0;

  /// As a plant records it.
  [[nodiscard]] world::PlantRecord record() const {
    world::PlantRecord all({{.name = "los.rate.pitch"},
                            {.name = "los.rate.yaw"},
                            {.name = "plant.time_to_go"},
                            {.name = "plant.relative.x"},
                            {.name = "plant.relative.y"},
                            {.name = "plant.relative.z"}});
    all.add(0, std::array<double, 6>{});
    for (const Sample& one : epochs)
      all.add(one.t_us,
              std::array{one.los_rate.pitch, one.los_rate.yaw, one.time_to_go(), one.range, 0., 0.});
    if (miss_n) {
      all.add(passage_us, std::array{0., 0., 0., miss_n->x(), miss_n->y(), miss_n->z()});
      all.ended_us = passage_us;
    }
    return all;
  }
};

/// A missile passes its flight target after 5 s at 1000 m/s. The seeker samples at 100 Hz, and the LOS rate
/// is constant. The run goes on for another second.
class FlyPast : public testing::Test {
 protected:
  static constexpr std::int64_t period_us = 10'000, passage_us = 5'000'000, duration_us = 6'000'000;

  FlyPast() {
    for (std::int64_t t_us = period_us; t_us < passage_us; t_us += period_us)
      flight_.epochs.push_back({.t_us = t_us,
                                .range = 1e-3 * static_cast<double>(passage_us - t_us),
                                .los_rate = {.pitch = 0.01, .yaw = -0.02}});
    flight_.miss_n = world::Vector3(0, 0.3, 0.4);
    flight_.passage_us = passage_us;
  }
  /// The truth of the flight as it is now; valid until the next call.
  [[nodiscard]] estimators::Truth truth() const {
    record_.emplace(flight_.record());
    return {.flight = rest_, .duration_us = duration_us, .plants = {&*record_}};
  }

  Flown flight_;
  const world::FlightRecord rest_{{.start = {}, .motion = world::Rest{}}, duration_us, 10'000};

 private:
  mutable std::optional<world::PlantRecord> record_;
};

}  // namespace canhil::checks
