// Samples of a periodic node that are not sent.
#pragma once

#include "bench/scenario/section.hpp"
#include "bench/world/stream.hpp"

namespace canhil::nodes {

struct SampleLoss {
  double probability = 0;            ///< of each sample, on its own
  std::int64_t outage_us = 0;        ///< nothing valid in the last so many microseconds ...
  std::int64_t outage_every_us = 0;  ///< ... of each such period; 0: no outages
};

/// The keys loss_percent, outage_s and outage_every_s of a node's table.
SampleLoss read_sample_loss(scenario::Section& section);

/// Whether a sample falls into an outage.
constexpr bool in_outage(const SampleLoss& loss, std::int64_t valid_us) {
  return loss.outage_every_us > 0 && valid_us % loss.outage_every_us >= loss.outage_every_us - loss.outage_us;
}

/// Whether a sample is lost, by chance or in an outage. Draws one number for every sample, also in an outage:
/// a loss changes no later one.
inline bool is_lost(const SampleLoss& loss, std::int64_t valid_us, world::Stream& losses) {
  const bool by_chance = losses.uniform() < loss.probability;
  return by_chance || in_outage(loss, valid_us);
}

}  // namespace canhil::nodes
