#include "bench/checks/probability.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace canhil::checks {

using boost::math::complement;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t above = values.size() / 2, below = (values.size() - 1) / 2;
  return (values[below] + values[above]) / 2;
}

double chi_squared_quantile(double degrees_of_freedom, double p) {
  return quantile(boost::math::chi_squared(degrees_of_freedom), p);
}

double chi_squared_quantile_above(double degrees_of_freedom, double p) {
  return quantile(complement(boost::math::chi_squared(degrees_of_freedom), p));
}

MeanBounds mean_of_squares_bounds(double runs, double degrees_of_freedom, double tail) {
  return {chi_squared_quantile(degrees_of_freedom * runs, tail) / runs,
          chi_squared_quantile_above(degrees_of_freedom * runs, tail) / runs};
}

double normal_above(double z) { return cdf(complement(boost::math::normal(), z)); }

double student_t_above(double degrees_of_freedom, double t) {
  return cdf(complement(boost::math::students_t(degrees_of_freedom), t));
}

double student_t_quantile_above(double degrees_of_freedom, double p) {
  return quantile(complement(boost::math::students_t(degrees_of_freedom), p));
}

SuccessBounds success_bounds(double trials, double successes, double tail) {
  using Binomial = boost::math::binomial_distribution<double>;
  return {Binomial::find_lower_bound_on_p(trials, successes, tail),
          Binomial::find_upper_bound_on_p(trials, successes, tail)};
}

}  // namespace canhil::checks
