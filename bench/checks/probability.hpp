// Quantiles and bounds of distributions, from Boost.Math. Only one source file includes Boost.Math, because
// it takes seconds to compile.
#pragma once

namespace canhil::checks {

/// x with P(chi-squared of k degrees of freedom <= x) = p.
double chi_squared_quantile(double degrees_of_freedom, double p);
/// x with P(chi-squared of k degrees of freedom > x) = p. For small p, this is more accurate than the
/// quantile of 1 - p.
double chi_squared_quantile_above(double degrees_of_freedom, double p);

/// P(Z > z) of a standard normal Z.
double normal_above(double z);

/// P(T > t) of Student's T.
double student_t_above(double degrees_of_freedom, double t);

/// Clopper-Pearson bounds of the probability of a success: the true probability lies beyond each bound with
/// probability at most `tail`.
struct SuccessBounds {
  double low, high;
};
SuccessBounds success_bounds(double trials, double successes, double tail);

}  // namespace canhil::checks
