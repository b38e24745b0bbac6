#include "bench/scenario/schedule.hpp"

#include "bench/scenario/section.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::scenario {

Schedule read_schedule(Section& section) {
  return {.period_us =
              section.optional_time_us({"period_ms",
                                        "Time from one sample to the next. Default: the cycle time in the "
                                        "DBC. If the value differs from the cycle time, the report says so."},
                                       Limits::between(1, 10'000)),
          .latency_us = section.time_us(
              {"latency_ms",
               "Delay between the time of validity of a sample and the transmission of the sample."},
              Limits::between(0, 10'000), 0)};
}

Schedule read_glide_schedule(Section& section) {
  const Schedule schedule = read_schedule(section);
  if (schedule.period_us && *schedule.period_us % world::GlideRecord::step_us != 0)
    section.reject("period_ms", "is not a multiple of the truth's step", "a multiple of 10");
  return schedule;
}

}  // namespace canhil::scenario
