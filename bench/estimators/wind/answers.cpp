#include "bench/estimators/wind/answers.hpp"

#include <cmath>
#include <optional>

#include "bench/world/units.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;
using world::Vector3;

struct WindGroup : AnswerGroup<WindVector, WindSpeed, WindSigma, WindCorrelation, WindTrackSigma,
                               WindAirVelocity, messages::WindAttitude, WindInnovation, WindUpdate> {
  void add(std::int64_t cause_us, WindAnswers& answers) const {
    const auto& wind = get<WindVector>();
    const auto& status = get<WindSpeed>();
    const auto& sigma = get<WindSigma>();
    const auto& correlation = get<WindCorrelation>();
    const auto& track = get<WindTrackSigma>();
    const int outside = status.outside_alpha | status.outside_beta | status.outside_speed |
                        status.outside_mach | status.outside_altitude | status.outside_pitch;
    answers.push_back(
        {.cause_us = cause_us,
         .started = wind.started != 0,
         .outcome = status.outcome,
         .outside = outside != 0,
         .fins_late = status.fins_late != 0,
         .fins_missing = status.fins_missing != 0,
         .fins_not_physical = status.fins_not_physical != 0,
         .theta_capped = status.theta_capped != 0,
         .degraded = status.degraded != 0,
         .wind_n = {wind.wind_north_mps, wind.wind_east_mps, wind.wind_down_mps},
         .sigma = {sigma.wind_sigma_north_mps, sigma.wind_sigma_east_mps, sigma.wind_sigma_down_mps},
         .correlation = {correlation.wind_correlation_ne, correlation.wind_correlation_nd,
                         correlation.wind_correlation_ed},
         .speed = status.wind_speed_mps,
         .from = status.wind_from_deg * world::units::deg,
         .speed_sigma = track.wind_speed_sigma_mps,
         .from_sigma = track.wind_from_sigma_deg * world::units::deg,
         .along_track_sigma = track.along_track_sigma_mps,
         .cross_track_sigma = track.cross_track_sigma_mps,
         .nis = get<WindUpdate>().nis});
  }
};

// None: the filter does not run, or the cause is no time of the record.
std::optional<WindError> error_of(const WindAnswer& answer, const TrueAir& air) {
  if (!answer.started || !air.record().row(answer.cause_us)) return std::nullopt;
  const auto [north, east, down, v_north, v_east, v_down] = *air.at(answer.cause_us);
  const Eigen::Vector2d along = Eigen::Vector2d(v_north, v_east).normalized();
  const Vector3 error = answer.wind_n - Vector3(north, east, down);
  return WindError{.t_us = answer.cause_us,
                   .error_n = error,
                   .along_track = along.x() * error.x() + along.y() * error.y(),
                   .cross_track = -along.y() * error.x() + along.x() * error.y(),
                   .speed = answer.speed - std::hypot(north, east),
                   .from = world::wrapped(answer.from - std::atan2(-east, -north))};
}

}  // namespace

std::unique_ptr<Reception> wind_reception() {
  return std::make_unique<ReceptionOf<WindAnswers, WindGroup>>();
}

Spool<WindError> wind_errors(const WindAnswers& answers, const TrueAir& air) {
  Spool<WindError> errors;
  for (std::size_t index = 0; index < answers.size(); ++index) {
    auto error = error_of(answers[index], air);
    if (!error) continue;
    error->answer = index;
    errors.push_back(*error);
  }
  return errors;
}

Spool<quantities::TrackPoint> nis_of(const WindAnswers& answers) {
  Spool<quantities::TrackPoint> all;
  for (const WindAnswer& answer : answers) {
    if (answer.outcome == messages::WindOutcome::updated) all.push_back({answer.cause_us, answer.nis});
  }
  return all;
}

Spool<quantities::TrackPoint> nees_of(const WindAnswers& answers, const TrueAir& air) {
  Spool<quantities::TrackPoint> all;
  for (const WindAnswer& answer : answers) {
    if (const auto error = error_of(answer, air))
      all.push_back({answer.cause_us, nees(error->error_n, answer.sigma, answer.correlation)});
  }
  return all;
}

}  // namespace canhil::estimators
