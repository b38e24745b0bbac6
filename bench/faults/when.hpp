// At which times a fault is active, and which frames or samples it affects at these times.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "bench/scenario/expression.hpp"
#include "bench/scenario/faults.hpp"
#include "bench/world/stream.hpp"

namespace canhil::faults {

/// When a fault was active that begins in the run, by a condition or a command. Ends included.
struct Trigger {
  static constexpr std::int64_t never_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t from_us = never_us, to_us = never_us;
};

/// The active time within a run: all of [from, to] or, within [from, to], the first `for_us` of each period
/// `each_us`.
struct When {
  static constexpr std::int64_t always_us = std::numeric_limits<std::int64_t>::max();
  std::int64_t from_us = 0, to_us = always_us;  ///< ends included
  std::int64_t for_us = 0, each_us = 0;         ///< 0: no periods
  std::int64_t every = 1;                       ///< affects only the first of every `every` frames or samples
  double share = 1;                             ///< affects only a random fraction of those frames or samples
  /// A fault that begins in the run. Its `from_us` is Trigger::never_us, and `to_us` is not used.
  bool on_command = false;                          ///< it waits for a command
  std::optional<scenario::Expression> condition{};  ///< it begins when this is not 0
  std::int64_t lasts_us = Trigger::never_us;
  const Trigger* trigger = nullptr;  ///< of the run; null: outside a run, or the times are known before it

  [[nodiscard]] bool begins_in_run() const { return on_command || condition; }
  [[nodiscard]] std::int64_t begins_us() const { return trigger != nullptr ? trigger->from_us : from_us; }
  [[nodiscard]] std::int64_t ends_us() const { return trigger != nullptr ? trigger->to_us : to_us; }
  [[nodiscard]] bool holds(std::int64_t t_us) const {
    return t_us >= begins_us() && t_us <= ends_us() &&
           (each_us == 0 || (t_us - begins_us()) % each_us < for_us);
  }
  /// The index of the period that contains `t_us`.
  [[nodiscard]] std::int64_t period(std::int64_t t_us) const {
    return each_us == 0 ? 0 : (t_us - begins_us()) / each_us;
  }
};

/// What a fault affects: individual frames or samples (each), or everything during its active time (stretch).
enum class Repeats : std::uint8_t { each, stretch };

/// Reads the keys from_s, to_s, for_s and each_s, or `when` and for_s. With Repeats::each, also reads the
/// keys every and percent.
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
