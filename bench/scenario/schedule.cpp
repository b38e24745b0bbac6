#include "bench/scenario/schedule.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Schedule read_schedule(Section& section) {
  return {.period_us = section.optional_time_us("period_ms", Limits::between(1, 10'000)),
          .latency_us = section.time_us("latency_ms", Limits::between(0, 10'000), 0)};
}

}  // namespace canhil::scenario
