#include "bench/estimators/freshness.hpp"

#include <algorithm>
#include <cmath>

namespace canhil::estimators {
namespace {

/// The number of periods that may pass without a fix before this counts as silence, if each fix is lost with
/// a given probability. It is the smallest n with probability^n <= 1e-6, but at least tolerated_fixes + 1.
double periods_of_fixes(double loss_probability) {
  constexpr double improbable = 1e-6;
  constexpr double most_periods = 1e6;
  constexpr double without_loss = checks::tolerated_fixes + 1;
  if (loss_probability <= 0) return without_loss;
  if (loss_probability >= 1) return most_periods;
  return std::max(without_loss, std::ceil(std::log(improbable) / std::log(loss_probability)));
}

}  // namespace

double period_us(const scenario::NodeSettings& node) { return static_cast<double>(node.period_us()); }

double longest_wait_of_fixes_us(const scenario::NodeSettings& aid) {
  return checks::longest_wait_us(period_us(aid), periods_of_fixes(aid.table().aid->lost(aid))) +
         static_cast<double>(aid.latency_us());
}

}  // namespace canhil::estimators
