// Two recorded runs, compared frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "dbc/ports/candump_log.hpp"

namespace canhil::observe {

/// The first frame in which two runs differ: the n-th of those compared (from 0), as it stands in each log.
struct Divergence {
  std::size_t index = 0;
  std::optional<LogEntry> a;  ///< none: this run has no such frame any more
  std::optional<LogEntry> b;
  double t_s = 0;  ///< bench time of the last Sync before it
};

struct Comparison {
  std::size_t compared = 0;  ///< frames of the target that agree
  std::optional<Divergence> first;
};

/// Compares what the target sent in two logs, from the first Sync on. Time stamps do not count, nor do frames
/// that speak of the host (TargetTiming) or only exist in virtual time (StepDone). Error: a log cannot be
/// read.
Result<Comparison> compare(const std::string& log_a, const std::string& log_b);

/// A frame as a person reads it: message, signals with units.
std::string describe(const Frame& frame);

}  // namespace canhil::observe
