// Losses of samples of a periodic node.
#pragma once

#include "bench/scenario/section.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

struct SampleLoss {
  double probability = 0;      ///< for each sample independently
  std::int64_t outage_us = 0;  ///< length of the outage at the end of each period; all samples in it are lost
  std::int64_t outage_every_us = 0;  ///< period of the outages; 0: no outages
};

/// The keys loss_percent, outage_s and outage_every_s of a node's table.
SampleLoss read_sample_loss(scenario::Section& section);

/// Whether a sample falls into an outage.
constexpr bool in_outage(const SampleLoss& loss, std::int64_t valid_us) {
  return loss.outage_every_us > 0 && valid_us % loss.outage_every_us >= loss.outage_every_us - loss.outage_us;
}

/// Whether a sample is lost, by chance or in an outage. Every call draws one number, also during an outage,
/// so that an outage does not change which later samples are lost.
inline bool is_lost(const SampleLoss& loss, std::int64_t valid_us, world::Stream& losses) {
  const bool by_chance = losses.uniform() < loss.probability;
  return by_chance || in_outage(loss, valid_us);
}

}  // namespace canhil::sensors
