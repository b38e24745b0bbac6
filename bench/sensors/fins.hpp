// The fin actuators of the glider: the deflections.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"

namespace canhil::sensors {

/// The table [fins].
struct FinsSettings {
  scenario::Schedule schedule{};
  std::int64_t stamp_error_us = 0;  ///< a fault: the reported minus the correct time of validity
  SampleLoss loss{};
};

extern const struct Kind fins;

}  // namespace canhil::sensors
