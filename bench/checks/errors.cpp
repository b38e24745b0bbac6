#include "bench/checks/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canhil::checks {
namespace {

using world::Matrix3;
using world::Vector3;

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// The covariance of the misalignment from what the bus carries.
Matrix3 covariance(const FilterAnswer& answer) {
  const Vector3& s = answer.attitude_sigma;
  const Vector3& r = answer.attitude_correlation;
  Matrix3 P;
  P << s.x() * s.x(), r.x() * s.x() * s.y(), r.y() * s.x() * s.z(),  //
      r.x() * s.x() * s.y(), s.y() * s.y(), r.z() * s.y() * s.z(),   //
      r.y() * s.x() * s.z(), r.z() * s.y() * s.z(), s.z() * s.z();
  return P;
}

}  // namespace

std::vector<NavigationError> navigation_errors(const Observations& seen, const world::FlightRecord& truth) {
  std::vector<NavigationError> errors;
  errors.reserve(seen.navigation.size());
  for (const NavigationAnswer& answer : seen.navigation) {
    if (answer.cause_us < 0 || answer.cause_us > truth.end_us()) continue;
    const world::Truth at = truth.at(answer.cause_us);
    const world::Euler angles = world::euler_from(at.C_bn);
    errors.push_back(
        {.t_us = answer.cause_us,
         .angles = {wrapped(answer.angles.roll - angles.roll), wrapped(answer.angles.pitch - angles.pitch),
                    wrapped(answer.angles.heading - angles.heading)},
         .v_eb_n = answer.v_eb_n - at.v_eb_n,
         .misalignment = world::misalignment(world::C_bn_from(answer.angles), at.C_bn)});
  }
  return errors;
}

std::vector<Normalised> attitude_nees(const Observations& seen, const std::vector<NavigationError>& errors) {
  std::vector<Normalised> series;
  for (const FilterAnswer& answer : seen.filter) {
    const auto after = std::ranges::upper_bound(errors, std::max(answer.cause_us, answer.navigation_us), {},
                                                &NavigationError::t_us);
    if (after == errors.end()) continue;
    const Eigen::LDLT<Matrix3> factor(covariance(answer));
    const bool positive = factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0;
    // A covariance that is not positive definite after rounding explains no error at all.
    const double nees = positive ? after->misalignment.dot(factor.solve(after->misalignment))
                                 : std::numeric_limits<double>::infinity();
    series.push_back({answer.cause_us, nees});
  }
  return series;
}

std::optional<std::int64_t> convergence_us(const std::vector<NavigationError>& errors,
                                           double world::Euler::*angle, double within_rad) {
  const auto outside = std::find_if(errors.rbegin(), errors.rend(), [&](const NavigationError& error) {
    return !(std::abs(error.angles.*angle) <= within_rad);  // NaN is outside
  });
  if (errors.empty() || outside == errors.rbegin()) return std::nullopt;
  return outside.base()->t_us;
}

}  // namespace canhil::checks
