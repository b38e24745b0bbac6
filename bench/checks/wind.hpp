// Wind estimates against a glider's truth.
#pragma once

#include <vector>

#include "bench/checks/errors.hpp"
#include "bench/world/glide/glide.hpp"

namespace canhil::checks {

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
std::vector<WindError> wind_errors(const Observations& seen, const world::GlideRecord& glide);

/// NIS (9 degrees of freedom) of each update.
std::vector<Normalised> wind_nis(const Observations& seen);
/// NEES of the wind (3 degrees of freedom), with the covariance that the bus carries.
std::vector<Normalised> wind_nees(const Observations& seen, const world::GlideRecord& glide);

}  // namespace canhil::checks
