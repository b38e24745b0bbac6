// LOS rate answers and their errors.
#pragma once

#include <memory>
#include <optional>

#include "bench/estimators/navigation.hpp"
#include "bench/world/planes.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::estimators {

/// The message group LosRate: the LOS rate at the time of a seeker sample, in the axes of the antenna. Units:
/// SI, angles in rad.
struct LosAnswer {
  std::int64_t cause_us = 0;
  messages::LosRateOutcome outcome = messages::LosRateOutcome::waiting;
  messages::LosRateFault fault = messages::LosRateFault::none;
  bool blind = false;  ///< the range is too small: the guidance must hold its command
  world::Planes<double> rate{};
  world::Planes<double> rate_sigma{};
  world::Planes<double> target{};  ///< acceleration of the target along z (pitch) and y (yaw)
  world::Planes<double> target_sigma{};
  double nis = 0;         ///< normalised innovation squared, 2 degrees of freedom; 0 without an update
  bool degraded = false;  ///< the target reports that its sigmas are not valid
};

using LosAnswers = InOrderOfCause<LosAnswer>;

/// True if the sample corrected the filter; false if the filter only predicted.
constexpr bool updated(messages::LosRateOutcome outcome) {
  return outcome == messages::LosRateOutcome::updated || outcome == messages::LosRateOutcome::start_up;
}
/// True if there is an estimate.
constexpr bool has_estimate(messages::LosRateOutcome outcome) {
  return updated(outcome) || outcome == messages::LosRateOutcome::coasting;
}

/// The error (estimated - true) of one LOS rate, at the time of validity of its sample.
struct LosError {
  std::int64_t t_us = 0;
  double time_to_go = 0;          ///< true range over closing speed [s]
  world::Planes<double> rate{};   ///< [rad/s]
  world::Planes<double> sigma{};  ///< as reported [rad/s]
  bool trusted = false;           ///< the answer reports neither blind nor degraded
  std::size_t answer = 0;         ///< index of the answer
};

/// The true values at the times of the samples: LOS rate in pitch and yaw, time to go.
using TrueLos = world::PlantColumns<3>;
inline constexpr TrueLos::Names true_los{"los.rate.pitch", "los.rate.yaw", "plant.time_to_go"};

/// Errors of all answers that have an estimate and whose time of cause is that of a sample.
Spool<LosError> los_errors(const LosAnswers& answers, const world::PlantRecords& plants);

/// The normalised innovation squared (NIS, 2 degrees of freedom) of each answer that was an update.
Spool<quantities::TrackPoint> nis_of(const LosAnswers& answers);

/// The RMS of the errors of both planes, for the errors whose time to go is at least `least` and below
/// `most`. None: no error has such a time to go.
std::optional<double> los_rms(const Spool<LosError>& errors, double least, double most);

std::unique_ptr<Reception> los_reception();

}  // namespace canhil::estimators
