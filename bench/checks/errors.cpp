#include "bench/checks/errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace canhil::checks {
namespace {

using world::Matrix3;
using world::Vector3;
using world::wrapped;

}  // namespace

const std::vector<NavigationAnswer>& navigation_of(const Observations& seen, Aligner aligner) {
  return aligner == Aligner::inflight_alignment ? seen.fix_navigation : seen.navigation;
}

std::vector<NavigationError> navigation_errors(const std::vector<NavigationAnswer>& answers,
                                               const world::FlightRecord& truth) {
  std::vector<NavigationError> errors;
  errors.reserve(answers.size());
  for (const NavigationAnswer& answer : answers) {
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

const NavigationError* first_after(const std::vector<NavigationError>& errors, std::int64_t cause_us,
                                   std::int64_t navigation_us) {
  const auto after =
      std::ranges::upper_bound(errors, std::max(cause_us, navigation_us), {}, &NavigationError::t_us);
  return after == errors.end() ? nullptr : &*after;
}

std::vector<Normalised> nis(const Observations& seen, Aligner aligner) {
  std::vector<Normalised> series;
  if (aligner == Aligner::transfer_alignment) {
    for (const FilterAnswer& answer : seen.filter) series.push_back({answer.cause_us, answer.nis});
    return series;
  }
  for (const FixAnswer& answer : seen.fixes) {
    if (used(answer.outcome)) series.push_back({answer.cause_us, answer.nis});
  }
  return series;
}

double nees(const Vector3& error, const Vector3& sigma, const Vector3& correlation) {
  const Vector3& s = sigma;
  const Vector3& r = correlation;
  Matrix3 P;
  P << s.x() * s.x(), r.x() * s.x() * s.y(), r.y() * s.x() * s.z(),  //
      r.x() * s.x() * s.y(), s.y() * s.y(), r.z() * s.y() * s.z(),   //
      r.y() * s.x() * s.z(), r.z() * s.y() * s.z(), s.z() * s.z();
  const Eigen::LDLT<Matrix3> factor(P);
  const bool positive = factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0;
  return positive ? error.dot(factor.solve(error)) : std::numeric_limits<double>::infinity();
}

std::vector<Normalised> attitude_nees(const Observations& seen, const std::vector<NavigationError>& errors) {
  std::vector<Normalised> series;
  for (const FilterAnswer& answer : seen.filter) {
    const NavigationError* after = first_after(errors, answer.cause_us, answer.navigation_us);
    if (after == nullptr) continue;
    series.push_back(
        {answer.cause_us, nees(after->misalignment, answer.attitude_sigma, answer.attitude_correlation)});
  }
  return series;
}

std::vector<Normalised> heading_nees(const Observations& seen, Aligner aligner,
                                     const std::vector<NavigationError>& errors) {
  std::vector<Normalised> series;
  const auto add = [&](const auto& answer, double sigma) {
    const NavigationError* after = first_after(errors, answer.cause_us, answer.navigation_us);
    if (after != nullptr) series.push_back({answer.cause_us, std::pow(after->angles.heading / sigma, 2)});
  };
  if (aligner == Aligner::transfer_alignment) {
    for (const FilterAnswer& answer : seen.filter) add(answer, answer.attitude_sigma.z());
    return series;
  }
  for (const FixAnswer& answer : seen.fixes) {
    if (used(answer.outcome)) add(answer, answer.heading_sigma);
  }
  return series;
}

bool tells_of_its_time(const FixAnswer& answer, const world::FlightRecord& truth) {
  const bool considered = used(answer.outcome) || answer.outcome == messages::FixOutcome::gated;
  return considered && answer.cause_us >= 0 && answer.cause_us <= truth.end_us();
}

Vector3 position_error(const FixAnswer& answer, const world::FlightRecord& truth) {
  return world::displacement_n(truth.at(answer.cause_us).position, answer.position);
}

std::vector<PositionError> position_errors(const Observations& seen, const world::FlightRecord& truth) {
  std::vector<PositionError> errors;
  for (const FixAnswer& answer : seen.fixes) {
    if (tells_of_its_time(answer, truth)) errors.push_back({answer.cause_us, position_error(answer, truth)});
  }
  return errors;
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
