#include "bench/scenario/schedule.hpp"

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

Schedule read_constant_schedule(Section& section) {
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

Schedule read_schedule(Section& section) {
  Schedule schedule = read_constant_schedule(section);
  schedule.latency_spread_us = section.time_us(
      {"latency_spread_ms",
       "Further delay, drawn for each sample between 0 and this value. The order of the samples is kept."},
      Limits::between(0, 10'000), 0);
  schedule.jitter = section.number(
      {"sampling_jitter_us",
       "1-sigma of the time at which a sample is taken, about its time of validity; at most half a period."},
      Limits::at_least(0), 0);
  return schedule;
}

}  // namespace canhil::scenario
