// Answers of a wind filter and their errors.
#pragma once

#include <memory>

#include "bench/estimators/navigation.hpp"
#include "bench/world/attitude.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::estimators {

/// The message group Wind: the result of the wind filter for one GliderNav group. Units: SI, angles in rad;
/// axes: NED.
struct WindAnswer {
  std::int64_t cause_us = 0;
  bool started = false;  ///< the filter runs; false: only the wind is valid
  messages::WindOutcome outcome = messages::WindOutcome::waiting;
  bool outside = false;  ///< some variable is outside the range of the model
  bool fins_late = false;
  bool fins_missing = false;
  bool fins_not_physical = false;
  bool theta_capped = false;
  bool degraded = false;  ///< the target reports that its sigmas are not valid
  world::Vector3 wind_n = world::Vector3::Zero();
  world::Vector3 sigma = world::Vector3::Zero();
  world::Vector3 correlation = world::Vector3::Zero();  ///< north-east, north-down, east-down
  double speed = 0;                                     ///< of the horizontal wind
  double from = 0;  ///< direction from which it blows, clockwise from north
  double speed_sigma = 0;
  double from_sigma = 0;
  double along_track_sigma = 0;
  double cross_track_sigma = 0;
  double nis = 0;  ///< normalised innovation squared, 9 degrees of freedom; 0: without an update
};

using WindAnswers = InOrderOfCause<WindAnswer>;

/// The error (estimated - true) of a wind answer, at the time of validity of its cause. Only answers of a
/// started filter have an error. "Along track" is the direction of the true horizontal air velocity, which is
/// close to the heading. The air speed is the least observable quantity.
struct WindError {
  std::int64_t t_us = 0;
  world::Vector3 error_n = world::Vector3::Zero();  ///< NED [m/s]
  double along_track = 0;                           ///< [m/s]
  double cross_track = 0;                           ///< to the right [m/s]
  double speed = 0;                                 ///< of the speed of the horizontal wind [m/s]
  double from = 0;                                  ///< of its direction, within +-pi [rad]
  std::size_t answer = 0;                           ///< index of the answer
};

/// The wind and the velocity through the air, both NED [m/s].
using TrueAir = world::PlantColumns<6>;
inline constexpr TrueAir::Names true_air{"wind.north",
                                         "wind.east",
                                         "wind.down",
                                         "plant.air_velocity.north",
                                         "plant.air_velocity.east",
                                         "plant.air_velocity.down"};

/// Errors of all answers of a running filter whose cause is a time of the record.
Spool<WindError> wind_errors(const WindAnswers& answers, const TrueAir& air);

/// NIS (9 degrees of freedom) of each update.
Spool<quantities::TrackPoint> nis_of(const WindAnswers& answers);
/// NEES of the wind (3 degrees of freedom), with the covariance on the bus.
Spool<quantities::TrackPoint> nees_of(const WindAnswers& answers, const TrueAir& air);

std::unique_ptr<Reception> wind_reception();

}  // namespace canhil::estimators
