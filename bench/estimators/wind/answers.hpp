// What a wind filter answers, against a glider's truth.
#pragma once

#include <memory>

#include "bench/estimators/navigation.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::estimators {

/// Group Wind: what the wind filter made of a GliderNav group. SI, rad, NED.
struct WindAnswer {
  std::int64_t cause_us = 0;
  bool started = false;  ///< the filter runs; else only the wind counts
  messages::WindOutcome outcome = messages::WindOutcome::waiting;
  bool outside = false;  ///< of the range of the model, in any of its variables
  bool fins_late = false;
  bool fins_missing = false;
  bool fins_not_physical = false;
  bool theta_capped = false;
  bool degraded = false;  ///< it says that its sigmas do not hold
  world::Vector3 wind_n = world::Vector3::Zero();
  world::Vector3 sigma = world::Vector3::Zero();
  world::Vector3 correlation = world::Vector3::Zero();  ///< north-east, north-down, east-down
  double along_track_sigma = 0;
  double cross_track_sigma = 0;
  double nis = 0;  ///< of 9 degrees of freedom; 0: without an update
};

using WindAnswers = Spool<WindAnswer>;

/// The error (estimated - true) of one wind answer of a filter that had started, at the time of validity of
/// its cause. Along track is along the true horizontal air velocity, about the heading: the air speed is what
/// is observed least.
struct WindError {
  std::int64_t t_us = 0;
  world::Vector3 error_n = world::Vector3::Zero();  ///< NED [m/s]
  double along_track = 0;                           ///< [m/s]
  double cross_track = 0;                           ///< to the right [m/s]
};

/// Errors of all answers of a running filter whose cause lies within the record.
Spool<WindError> wind_errors(const WindAnswers& answers, const world::GlideRecord& glide);

/// NIS (9 degrees of freedom) of each update.
Spool<quantities::TrackPoint> nis_of(const WindAnswers& answers);
/// NEES of the wind (3 degrees of freedom), with the covariance that the bus carries.
Spool<quantities::TrackPoint> nees_of(const WindAnswers& answers, const world::GlideRecord& glide);

std::unique_ptr<Reception> wind_reception();

}  // namespace canhil::estimators
