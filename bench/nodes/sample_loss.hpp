// Samples of a periodic node that are not sent.
#pragma once

#include "bench/scenario/sample_loss.hpp"
#include "bench/world/stream.hpp"

namespace canhil::nodes {

/// Whether a sample is lost, by chance or in an outage. Draws one number for every sample, also in an outage:
/// a loss changes no later one.
inline bool is_lost(const scenario::SampleLoss& loss, std::int64_t valid_us, world::Stream& losses) {
  const bool by_chance = losses.uniform() < loss.probability;
  return by_chance || in_outage(loss, valid_us);
}

}  // namespace canhil::nodes
