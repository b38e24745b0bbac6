// [fins]: the glider's fin actuators, which tell their deflections.
#pragma once

#include <cstdint>

#include "bench/scenario/sample_loss.hpp"
#include "bench/scenario/schedule.hpp"

namespace canhil::scenario {

class Section;

struct Fins {
  Schedule schedule{};
  std::int64_t stamp_error_us = 0;  ///< a fault: the stamp is so much later than the time of validity
  SampleLoss loss{};
};

Fins read_fins(Section& section);

}  // namespace canhil::scenario
