// The delay of a reported quantity, estimated by comparison with the truth. If an answer does not name its
// cause, there is no other way to measure its delay.
#pragma once

#include "bench/quantities/track.hpp"
#include "bench/scenario/checks.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::checks {

struct Delay {
  double delay_s = 0;       ///< positive: the reported value belongs to an earlier time
  double half_width_s = 0;  ///< half-width of the 95 % interval
};

/// Fits the delay d and an offset b by least squares, so that estimate(t) is nearly truth(t - d) + b within a
/// window. The variance of d is computed as V / S * (1 + r) / (1 - r), where V is the variance of the
/// residuals, S is the sum of the squares of (rate of the truth minus mean rate), and r is the correlation of
/// successive residuals. Answers that are not a number are left out. The error states why the delay cannot be
/// determined: too few answers; the truth is constant, or changes at a constant rate; the answers do not
/// follow the truth; the half-width of the interval is above `coarsest_delay_s`; the best delay lies at an
/// end of the search; or two delays fit equally well.
Result<Delay> delay_of(const quantities::Track& track, const scenario::Window& window);
inline constexpr double coarsest_delay_s = 0.05;

}  // namespace canhil::checks
