// At which times a fault is active, and which frames or samples it affects at these times.
#pragma once

#include <cstdint>
#include <limits>

#include "bench/scenario/faults.hpp"
#include "bench/world/stream.hpp"

namespace canhil::faults {

/// The active time within a run: all of [from, to] or, within [from, to], the first `for_us` of each period
/// `each_us`.
struct When {
  static constexpr std::int64_t always_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t from_us = 0, to_us = always_us;  ///< ends included
  std::int64_t for_us = 0, each_us = 0;         ///< 0: no periods
  std::int64_t every = 1;                       ///< affects only the first of every `every` frames or samples
  double share = 1;                             ///< affects only a random fraction of those frames or samples

  [[nodiscard]] bool holds(std::int64_t t_us) const {
    return t_us >= from_us && t_us <= to_us && (each_us == 0 || (t_us - from_us) % each_us < for_us);
  }
  /// The index of the period that contains `t_us`.
  [[nodiscard]] std::int64_t period(std::int64_t t_us) const {
    return each_us == 0 ? 0 : (t_us - from_us) / each_us;
  }
};

/// What a fault affects: individual frames or samples (each), or everything during its active time (stretch).
enum class Repeats : std::uint8_t { each, stretch };

/// Reads the keys from_s, to_s, for_s and each_s. With Repeats::each, also reads the keys every and percent.
When read_when(scenario::Section& section, const scenario::FaultContext& context, Repeats repeats);

/// Reads from_s, to_s, for_s and each_s for a fault that must end before the run ends: for_s is required, and
/// the run must continue after the fault.
When read_stretches(scenario::Section& section, const scenario::FaultContext& context);

/// Decides for each frame or sample whether it is affected.
class Occasions {
 public:
  Occasions(const When& when, const world::Stream& stream) : when_(when), stream_(stream) {}

  /// The decision for the next frame or sample, at its time of transmission.
  bool next(std::int64_t t_us) {
    if (!when_.holds(t_us)) return false;
    const bool by_chance = when_.share >= 1 || stream_.uniform() < when_.share;
    return seen_++ % when_.every == 0 && by_chance;
  }

 private:
  When when_;
  world::Stream stream_;
  std::int64_t seen_ = 0;  // number of frames or samples during the active time
};

}  // namespace canhil::faults
