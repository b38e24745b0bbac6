// Compares the numbers of a check between the runs of two sides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/criterion.hpp"

namespace canhil::report {

/// Which difference between margins counts as worse.
struct FigureRule {
  double tolerance = 0;     ///< largest loss of margin that is not worse, as a share of the limit
  double largest_p = 0;     ///< several runs a side: largest p of a significant difference
  bool repeatable = false;  ///< equal runs have equal numbers: virtual time, and all runs have the same seed
};

struct FiguresCompared {
  enum class Change : std::uint8_t { same, changed, worse };
  Change change = Change::same;
  std::string text;  ///< "0.943 -> 1.37 mrad/s, limit < 2.3 mrad/s, margin 59 % -> 40.4 %"
};

/// Compares the judgements of a check in the runs `before` and `after`. Its margin got worse if it shrank by
/// more than the tolerance and, with several runs, if the difference of the means is significant (Student's
/// t). One run a side shows no scatter: its margin can only get worse if runs are repeatable. None: a side
/// has no value.
std::optional<FiguresCompared> compare_figures(const std::vector<checks::Judgement>& before,
                                               const std::vector<checks::Judgement>& after,
                                               const FigureRule& rule);

}  // namespace canhil::report
