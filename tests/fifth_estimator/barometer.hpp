// A barometer. Sends BarometerHeight.
#pragma once

#include "bench/nodes/sample_loss.hpp"
#include "bench/scenario/schedule.hpp"

namespace canhil::nodes {

/// The table [barometer].
struct BarometerSettings {
  scenario::Schedule schedule{};
  double noise = 0;  ///< 1-sigma per sample [m]
  SampleLoss loss{};
};

extern const struct Kind barometer;

}  // namespace canhil::nodes
