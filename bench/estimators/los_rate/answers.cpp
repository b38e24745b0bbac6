#include "bench/estimators/los_rate/answers.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;

struct LosGroup : AnswerGroup<LosRateEstimate, LosRateSigma, LosRateTarget> {
  void add(std::int64_t cause_us, LosAnswers& answers) const {
    const auto& estimate = get<LosRateEstimate>();
    const auto& sigma = get<LosRateSigma>();
    const auto& target = get<LosRateTarget>();
    answers.push_back(
        {.cause_us = cause_us,
         .outcome = estimate.outcome,
         .fault = estimate.fault,
         .blind = estimate.blind != 0,
         .rate = {.pitch = estimate.los_rate_pitch_radps, .yaw = estimate.los_rate_yaw_radps},
         .rate_sigma = {.pitch = sigma.los_rate_sigma_pitch_radps, .yaw = sigma.los_rate_sigma_yaw_radps},
         .target = {.pitch = target.target_acceleration_z_mps2, .yaw = target.target_acceleration_y_mps2},
         .target_sigma = {.pitch = sigma.target_acceleration_sigma_z_mps2,
                          .yaw = sigma.target_acceleration_sigma_y_mps2},
         .nis = sigma.nis,
         .degraded = sigma.degraded != 0});
  }
};

}  // namespace

std::unique_ptr<Reception> los_reception() { return std::make_unique<ReceptionOf<LosAnswers, LosGroup>>(); }

Spool<LosError> los_errors(const LosAnswers& answers, const world::PlantRecords& plants) {
  Spool<LosError> errors;
  const auto truth = TrueLos::find(plants, true_los);
  if (!truth) return errors;
  errors.reserve(answers.size());
  for (std::size_t index = 0; index < answers.size(); ++index) {
    const LosAnswer& answer = answers[index];
    const auto row = truth->record().row(answer.cause_us);
    if (!row || !has_estimate(answer.outcome)) continue;
    const auto [pitch, yaw, time_to_go] = truth->of_row(*row);
    errors.push_back({.t_us = answer.cause_us,
                      .time_to_go = time_to_go,
                      .rate = {.pitch = answer.rate.pitch - pitch, .yaw = answer.rate.yaw - yaw},
                      .sigma = answer.rate_sigma,
                      .trusted = !answer.blind && !answer.degraded,
                      .answer = index});
  }
  return errors;
}

Spool<quantities::TrackPoint> nis_of(const LosAnswers& answers) {
  Spool<quantities::TrackPoint> series;
  for (const LosAnswer& answer : answers) {
    if (updated(answer.outcome)) series.push_back({answer.cause_us, answer.nis});
  }
  return series;
}

std::optional<double> los_rms(const Spool<LosError>& errors, double least, double most) {
  double squares = 0;
  int count = 0;
  for (const LosError& error : errors) {
    if (error.time_to_go < least || error.time_to_go >= most) continue;
    squares += error.rate.pitch * error.rate.pitch;
    squares += error.rate.yaw * error.rate.yaw;
    count += 2;
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / count);
}

}  // namespace canhil::estimators
