// Counts the runs of a variant whose errors are too large, or of which a warning came too late or ended too
// early.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bench/campaign/series.hpp"

namespace canhil::campaign {

/// Counts runs that ended early, and runs whose |quantity| is above a bound (SI) or not finite, or that have
/// no finite NEES or NIS there.
struct Divergence {
  std::size_t faulted = 0;
  std::size_t beyond = 0;  ///< completed runs with such a value
  std::size_t runs = 0;
  double largest = 0;  ///< the largest |quantity| of the completed runs
  /// With `within_us`: completed runs in which any answer was above the bound; those of them in which this
  /// came too shortly before the end to judge what follows.
  std::size_t ever_above = 0, too_late = 0;
};
/// With `from_us`, all samples from this time on are judged; without `from_us`, only the last update is
/// judged. With `within_us`, a sample above the bound counts only later than this after the run's first
/// sample above it, of trusted answers or others (Quantity::of_every_answer). A run that is silent after this
/// time counts, because silence is no warning.
Divergence divergence(std::span<const RunSeries> runs, const Quantity& quantity, double bound,
                      std::optional<std::int64_t> from_us = std::nullopt,
                      std::optional<std::int64_t> within_us = std::nullopt);

}  // namespace canhil::campaign
