#include "bench/estimators/navigation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace canhil::estimators {

using world::Matrix3;
using world::Vector3;
using world::wrapped;

namespace {

NavigationError error_of(const NavigationAnswers& navigation, std::size_t index,
                         const world::FlightRecord& truth) {
  const NavigationAnswer& answer = navigation[index];
  const world::Truth at = truth.at(answer.cause_us);
  const world::Euler angles = world::euler_from(at.C_bn);
  return {.t_us = answer.cause_us,
          .angles = {wrapped(answer.angles.roll - angles.roll), wrapped(answer.angles.pitch - angles.pitch),
                     wrapped(answer.angles.heading - angles.heading)},
          .v_eb_n = answer.v_eb_n - at.v_eb_n,
          .misalignment = world::misalignment(world::C_bn_from(answer.angles), at.C_bn),
          .answer = index};
}

}  // namespace

const Spool<NavigationError>& NavigationAnswers::errors(const world::FlightRecord& truth) const {
  if (truth_ == &truth && of_revision_ == revision()) return errors_;
  Spool<NavigationError> errors;
  errors.reserve(size());
  for (std::size_t index = 0; index < size(); ++index) {
    const std::int64_t t_us = (*this)[index].cause_us;
    if (t_us >= 0 && t_us <= truth.known_until_us()) errors.push_back(error_of(*this, index, truth));
  }
  errors_ = std::move(errors);
  truth_ = &truth;
  of_revision_ = revision();
  return errors_;
}

std::optional<NavigationError> NavigationAnswers::first_after(std::int64_t cause_us,
                                                              std::int64_t navigation_us,
                                                              const world::FlightRecord& truth) const {
  const std::int64_t before_us = std::max({cause_us, navigation_us, std::int64_t{-1}});
  const auto after = std::ranges::upper_bound(in_order(), before_us, {}, &NavigationAnswer::cause_us);
  if (after == end() || after->cause_us > truth.known_until_us()) return std::nullopt;
  return error_of(*this, static_cast<std::size_t>(after - begin()), truth);
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

}  // namespace canhil::estimators
