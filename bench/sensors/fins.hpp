// The fin actuators of the glider. Sends FinDeflections: the deflections and their time.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"

namespace canhil::sensors {

/// The table [fins].
struct FinsSettings {
  scenario::Schedule schedule{};
  std::int64_t stamp_error_us = 0;  ///< a fault: the sent minus the correct time of validity
  SampleLoss loss{};
};

extern const struct Kind fins;

}  // namespace canhil::sensors
