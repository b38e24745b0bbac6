// Estimates against the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::checks {

/// The errors (estimated - true) of one navigation answer, at the time of validity of its cause.
struct NavigationError {
  std::int64_t t_us = 0;
  world::Euler angles;  ///< differences of the Euler angles, wrapped to +-pi
  world::Vector3 v_eb_n = world::Vector3::Zero();
  world::Vector3 misalignment = world::Vector3::Zero();  ///< phi, NED: C_estimated = exp(-[phi x]) C_true
};

/// Errors of all navigation answers whose cause lies within the truth.
std::vector<NavigationError> navigation_errors(const Observations& seen, const world::FlightRecord& truth);

/// One normalised error squared.
struct Normalised {
  std::int64_t t_us = 0;
  double value = 0;
};

/// Attitude NEES (3 degrees of freedom) after each velocity update: phi' P^-1 phi, with P from the sigmas and
/// correlations on the bus and phi from the first navigation answer after the update: of a late fix not the
/// answers between its time of validity and its arrival, which knew nothing of it.
std::vector<Normalised> attitude_nees(const Observations& seen, const std::vector<NavigationError>& errors);

/// When |error| of an angle enters the band for good [us]; none: it is outside at the end.
std::optional<std::int64_t> convergence_us(const std::vector<NavigationError>& errors,
                                           double world::Euler::*angle, double within_rad);

}  // namespace canhil::checks
