// Two recorded runs, compared frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "dbc/logs/candump.hpp"

namespace canhil::observe {

/// The first frame in which two runs differ: the n-th of those compared (from 0), as it stands in each log.
struct Divergence {
  std::size_t index = 0;
  std::optional<LogEntry> a;  ///< none: this run has no such frame any more
  std::optional<LogEntry> b;
  double t_s = 0;        ///< bench time of the last Sync before it
  std::string signal{};  ///< "FixUpdate.nis is 3.21 in one, 3.18 in the other"; empty: other messages
};

struct Comparison {
  std::size_t compared = 0;  ///< frames of the target that agree
  std::optional<Divergence> first;
};

/// Compares what the target sent in two logs, from the first Sync on. Time stamps do not count, nor do frames
/// that speak of the host (TargetTiming) or only exist in virtual time (StepDone). `steps`: by how many steps
/// of its resolution a signal may be off; whole numbers, states and flags may not; 0: no bit may differ.
/// Error: a log cannot be read.
Result<Comparison> compare(const std::string& log_a, const std::string& log_b, double steps = 0);

/// A frame as a person reads it: message, signals with units.
std::string describe(const Frame& frame);

}  // namespace canhil::observe
