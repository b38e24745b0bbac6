// The delay of a reported quantity, estimated by comparison with the truth. Answers without a cause allow no
// other measurement of their delay.
#pragma once

#include <optional>

#include "bench/quantities/track.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

struct Delay {
  double delay_s = 0;       ///< positive: the reported value belongs to an earlier time
  double half_width_s = 0;  ///< half-width of the 95 % interval
};

/// The delay d, with an offset b, for which estimate(t) = truth(t - d) + b fits best within a window, by
/// least squares. The variance of d is the variance of the residuals, divided by the sum of the squares of
/// (rate of the truth minus mean rate), times (1 + r)/(1 - r). Here r is the correlation of successive
/// residuals. None: fewer than 20 answers, or the truth moves too little to determine the delay within
/// `coarsest_delay_s`.
std::optional<Delay> delay_of(const quantities::Track& track, const scenario::Window& window);
inline constexpr double coarsest_delay_s = 0.05;

}  // namespace canhil::checks
