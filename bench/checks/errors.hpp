// Estimates against the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/checks/observations.hpp"
#include "bench/scenario/checks.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::checks {

/// The estimators of attitude and velocity.
enum class Aligner : std::uint8_t { transfer_alignment, inflight_alignment };

/// The errors (estimated - true) of one navigation answer, at the time of validity of its cause.
struct NavigationError {
  std::int64_t t_us = 0;
  world::Euler angles;  ///< differences of the Euler angles, wrapped to +-pi
  world::Vector3 v_eb_n = world::Vector3::Zero();
  world::Vector3 misalignment = world::Vector3::Zero();  ///< phi, NED: C_estimated = exp(-[phi x]) C_true
};

/// What an estimator said of attitude and velocity.
const std::vector<NavigationAnswer>& navigation_of(const Observations& seen, Aligner aligner);

/// Errors of all navigation answers whose cause lies within the truth.
std::vector<NavigationError> navigation_errors(const std::vector<NavigationAnswer>& answers,
                                               const world::FlightRecord& truth);

/// One normalised error squared.
struct Normalised {
  std::int64_t t_us = 0;
  double value = 0;
};

/// The first navigation answer that knew of a filter update: of a late fix not those between its time of
/// validity and its arrival. `navigation_us` is the cause of the last one before the update. None: nullptr.
const NavigationError* first_after(const std::vector<NavigationError>& errors, std::int64_t cause_us,
                                   std::int64_t navigation_us);

/// NIS (3 degrees of freedom) of each update: of velocity updates, or of the fixes that the filter used.
std::vector<Normalised> nis(const Observations& seen, Aligner aligner);

/// error' P^-1 error, with P from the sigmas and correlations (north-east, north-down, east-down) that the
/// bus carries. Infinite: P is not positive definite, as rounding may leave it, and explains no error at all.
double nees(const world::Vector3& error, const world::Vector3& sigma, const world::Vector3& correlation);

/// Attitude NEES (3 degrees of freedom) after each velocity update: nees() of phi from first_after().
std::vector<Normalised> attitude_nees(const Observations& seen, const std::vector<NavigationError>& errors);

/// (error / sigma)^2 of the heading (1 degree of freedom) after each update, with the error from
/// first_after().
std::vector<Normalised> heading_nees(const Observations& seen, Aligner aligner,
                                     const std::vector<NavigationError>& errors);

/// The error (estimated - true) of one position, at the time of validity of its fix.
struct PositionError {
  std::int64_t t_us = 0;
  world::Vector3 displacement_n = world::Vector3::Zero();  ///< NED [m]
};

/// Whether the position in an answer holds at a known time: that of a fix that the filter used or gated.
bool tells_of_its_time(const FixAnswer& answer, const world::FlightRecord& truth);
/// Its error, NED [m].
world::Vector3 position_error(const FixAnswer& answer, const world::FlightRecord& truth);
/// Errors of all answers that hold at a known time.
std::vector<PositionError> position_errors(const Observations& seen, const world::FlightRecord& truth);

/// When |error| of an angle enters the band for good [us]; none: it is outside at the end.
std::optional<std::int64_t> convergence_us(const std::vector<NavigationError>& errors,
                                           double world::Euler::*angle, double within_rad);

}  // namespace canhil::checks
