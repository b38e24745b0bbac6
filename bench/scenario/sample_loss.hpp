// Samples of a periodic node that are not sent.
#pragma once

#include <cstdint>

namespace canhil::scenario {

class Section;

struct SampleLoss {
  double probability = 0;            ///< of each sample, on its own
  std::int64_t outage_us = 0;        ///< nothing valid in the last so many microseconds ...
  std::int64_t outage_every_us = 0;  ///< ... of each such period; 0: no outages
};

/// The keys loss_percent, outage_s and outage_every_s of a node's section.
SampleLoss read_sample_loss(Section& section);

/// Whether a sample falls into an outage.
constexpr bool in_outage(const SampleLoss& loss, std::int64_t valid_us) {
  return loss.outage_every_us > 0 && valid_us % loss.outage_every_us >= loss.outage_every_us - loss.outage_us;
}

}  // namespace canhil::scenario
