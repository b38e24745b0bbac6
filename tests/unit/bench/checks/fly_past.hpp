// A fly-past, whose answers tests judge.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "bench/checks/estimator.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::checks {

/// A missile passes its flight target after 5 s at 1000 m/s. The seeker samples at 100 Hz, and the LOS rate
/// is constant. The run goes on for another second.
class FlyPast : public testing::Test {
 protected:
  static constexpr std::int64_t period_us = 10'000, passage_us = 5'000'000, duration_us = 6'000'000;

  FlyPast() {
    for (std::int64_t t_us = period_us; t_us < passage_us; t_us += period_us) {
      world::EngagementTruth epoch;
      epoch.t_us = t_us;
      epoch.range = 1e-3 * static_cast<double>(passage_us - t_us);
      epoch.closing_speed = 1000;
      epoch.velocity_n = {-1000, 0, 0};
      epoch.los_rate = {.pitch = 0.01, .yaw = -0.02};
      flight_.epochs.push_back(epoch);
    }
    flight_.miss_n = world::Vector3(0, 0.3, 0.4);
    flight_.passage_us = passage_us;
  }
  [[nodiscard]] estimators::Truth truth() const {
    return {.flight = rest_, .duration_us = duration_us, .engagement = &flight_};
  }

  world::EngagementRecord flight_;
  const world::FlightRecord rest_{{.start = {}, .motion = world::Rest{}}, duration_us, 10'000};
};

}  // namespace canhil::checks
