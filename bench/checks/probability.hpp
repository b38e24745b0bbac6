// Quantiles and bounds of distributions, from Boost.Math. Only one source file includes Boost.Math, because
// Boost.Math takes seconds to compile.
#pragma once

#include <vector>

namespace canhil::checks {

/// The median of at least one value; of an even number, the mean of the two in the middle.
double median(std::vector<double> values);

/// The value x for which P(X <= x) is p, where X is chi-squared.
double chi_squared_quantile(double degrees_of_freedom, double p);
/// The value x for which P(X > x) is p, where X is chi-squared. For small p, this function is more accurate
/// than a call of chi_squared_quantile() with the probability 1 - p.
double chi_squared_quantile_above(double degrees_of_freedom, double p);

/// The values that chi2(k n) / n, the mean over n runs of a sum of k normalised squares, is below and above
/// with a probability of `tail` each.
struct MeanBounds {
  double low, high;
};
MeanBounds mean_of_squares_bounds(double runs, double degrees_of_freedom, double tail);

/// P(Z > z) of a standard normal Z.
double normal_above(double z);

/// P(T > t) of Student's T.
double student_t_above(double degrees_of_freedom, double t);
/// The value t for which P(T > t) is p.
double student_t_quantile_above(double degrees_of_freedom, double p);

/// Clopper-Pearson bounds for the probability of a success. The true probability is below `low` with a
/// probability of at most `tail`, and above `high` with a probability of at most `tail`.
struct SuccessBounds {
  double low, high;
};
SuccessBounds success_bounds(double trials, double successes, double tail);

}  // namespace canhil::checks
