// LOS rates against the engagement.
#pragma once

#include <optional>
#include <vector>

#include "bench/checks/errors.hpp"
#include "bench/world/engagement/engagement.hpp"

namespace canhil::checks {

/// The error (estimated - true) of one LOS rate, at the time of validity of its sample.
struct LosError {
  std::int64_t t_us = 0;
  double time_to_go = 0;         ///< true range over closing speed [s]
  world::Planes<double> rate{};  ///< [rad/s]
};

/// Errors of all answers that tell a rate, whose cause is an epoch of the engagement.
std::vector<LosError> los_errors(const Observations& seen, const world::EngagementRecord& engagement);

/// NIS (2 degrees of freedom) of each answer that was an update.
std::vector<Normalised> los_nis(const Observations& seen);

/// Root of the mean square, over both planes, of the errors with time to go in [least, most); none: no errors
/// there.
std::optional<double> los_rms(const std::vector<LosError>& errors, double least, double most);

}  // namespace canhil::checks
