// Compares two recorded runs frame by frame.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "dbc/logs/candump.hpp"

namespace canhil::observe {

/// The first difference between two runs. The frames that are compared have indices from 0; `index` is the
/// index of the first pair that differs, `a` and `b` are the two frames.
struct Divergence {
  std::size_t index = 0;
  std::optional<LogEntry> a;  ///< none: this run has no further frame
  std::optional<LogEntry> b;
  double t_s = 0;        ///< bench time of the last Sync before this frame
  std::string signal{};  ///< "FixUpdate.nis is 3.21 in one, 3.18 in the other"; empty: the messages differ,
                         ///< one run has no further frame, or no signal differs
};

struct Comparison {
  std::size_t compared = 0;  ///< frames of the target that agree
  std::optional<Divergence> first;
};

/// Compares the frames of the target in two logs, from the first Sync on. Ignores time stamps, frames about
/// the host (TargetTiming) and frames that exist in virtual time only (StepDone). `steps`: how many steps of
/// its resolution a signal may differ; 0: all bits must be equal. Whole numbers, states and flags must always
/// be equal. An error is returned if a log cannot be read.
Result<Comparison> compare(const std::string& log_a, const std::string& log_b, double steps = 0);

/// A frame as text: message and signals with units.
std::string describe(const Frame& frame);

}  // namespace canhil::observe
