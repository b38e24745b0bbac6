#include "bench/sensors/sample_loss.hpp"

namespace canhil::sensors {

using scenario::Limits;

SampleLoss read_sample_loss(scenario::Section& section) {
  const SampleLoss loss{
      .probability = section.number({"loss_percent", "Share of the samples that are not sent."},
                                    Limits::between(0, 100), 0),
      .outage_us = section.time_us(
          {"outage_s", "Length of an outage, in which no sample is sent. Needs `outage_every_s`."},
          Limits::at_least(0), 0),
      .outage_every_us =
          section.time_us({"outage_every_s",
                           "Period of the outages. Each period ends with an outage, so the first outage "
                           "begins at `outage_every_s` - `outage_s`. Needs `outage_s`."},
                          Limits::at_least(0), 0)};
  if ((loss.outage_us > 0) != (loss.outage_every_us > 0)) {
    section.reject(loss.outage_us > 0 ? "outage_s" : "outage_every_s", "is given alone",
                   "outage_s and outage_every_s, both above 0");
  } else if (loss.outage_us > loss.outage_every_us) {
    section.reject("outage_s", "is longer than outage_every_s", "a shorter outage");
  }
  return loss;
}

}  // namespace canhil::sensors
