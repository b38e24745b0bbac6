// How late a quantity is told, by the truth itself: of answers that do not say what they answer there is no
// other way to know.
#pragma once

#include <optional>

#include "bench/quantities/track.hpp"
#include "bench/scenario/checks.hpp"

namespace canhil::checks {

struct Delay {
  double delay_s = 0;       ///< positive: what is told is of an earlier time
  double half_width_s = 0;  ///< of the interval that holds it with 95 %
};

/// The delay d, with an offset b, for which estimate(t) = truth(t - d) + b fits best within a window, by
/// least squares. Its variance is that of the residuals over the sum of the squared rates of the truth, times
/// (1 + r)/(1 - r) for residuals correlated by r from one to the next. None: fewer than 20 answers, or the
/// truth moves too little to know it within `coarsest_delay_s`.
std::optional<Delay> delay_of(const quantities::Track& track, const scenario::Window& window);
inline constexpr double coarsest_delay_s = 0.05;

}  // namespace canhil::checks
