// Answers of a transfer alignment: its navigation, and its filter after each velocity update.
#pragma once

#include <memory>

#include "bench/estimators/navigation.hpp"

namespace canhil::estimators {

/// The message group AlignFilter: the state of the filter after a velocity update at the time of a master INS
/// sample. Units: SI, angles in rad.
struct FilterAnswer {
  std::int64_t cause_us = 0;
  std::int64_t navigation_us = -1;  ///< latest cause of the navigation answers before this one; -1: none
  double nis = 0;
  world::Vector3 innovation = world::Vector3::Zero();
  world::Vector3 attitude_sigma = world::Vector3::Zero();        ///< sigmas of the misalignment, NED
  world::Vector3 attitude_correlation = world::Vector3::Zero();  ///< north-east, north-down, east-down
  world::Vector3 velocity_sigma = world::Vector3::Zero();
  world::Vector3 gyro_bias = world::Vector3::Zero();   ///< body
  world::Vector3 accel_bias = world::Vector3::Zero();  ///< body
  bool degraded = false;                               ///< the target reports that its sigmas are not valid
};

struct TransferAnswers {
  NavigationAnswers navigation;
  InOrderOfCause<FilterAnswer> filter;
};

/// The attitude NEES (3 degrees of freedom) after each velocity update: the result of nees() for the
/// misalignment that first_after() finds.
Spool<quantities::TrackPoint> nees_of(const TransferAnswers& answers, const world::FlightRecord& truth);

std::unique_ptr<Reception> transfer_reception();

}  // namespace canhil::estimators
