#include "bench/estimators/wind/answers.hpp"

namespace canhil::estimators {
namespace {

using namespace messages;
using world::Vector3;

using WindGroup = AnswerGroup<WindVector, WindSpeed, WindSigma, WindCorrelation, WindTrackSigma,
                              WindAirVelocity, messages::WindAttitude, WindInnovation, WindUpdate>;

Whole add(const WindGroup& group, std::int64_t now_us, WindAnswers& answers) {
  const auto& wind = group.get<WindVector>();
  const auto& status = group.get<WindSpeed>();
  const auto& sigma = group.get<WindSigma>();
  const auto& correlation = group.get<WindCorrelation>();
  const auto& track = group.get<WindTrackSigma>();
  const auto& air = group.get<WindAirVelocity>();
  const auto& update = group.get<WindUpdate>();
  const std::int64_t cause_us = unwrap_us(update.cause_time_us, now_us);
  const int outside = status.outside_alpha | status.outside_beta | status.outside_speed |
                      status.outside_mach | status.outside_altitude | status.outside_pitch;
  answers.push_back(
      {.cause_us = cause_us,
       .started = wind.started != 0,
       .outcome = status.outcome,
       .fault = status.fault,
       .outside = outside != 0,
       .fins_late = status.fins_late != 0,
       .fins_missing = status.fins_missing != 0,
       .fins_not_physical = status.fins_not_physical != 0,
       .theta_capped = status.theta_capped != 0,
       .wind_n = {wind.wind_north_mps, wind.wind_east_mps, wind.wind_down_mps},
       .sigma = {sigma.wind_sigma_north_mps, sigma.wind_sigma_east_mps, sigma.wind_sigma_down_mps},
       .correlation = {correlation.wind_correlation_ne, correlation.wind_correlation_nd,
                       correlation.wind_correlation_ed},
       .along_track_sigma = track.along_track_sigma_mps,
       .cross_track_sigma = track.cross_track_sigma_mps,
       .v_a = {air.air_velocity_x_mps, air.air_velocity_y_mps, air.air_velocity_z_mps},
       .nis = update.nis});
  return {
      .messages = WindGroup::messages, .cause_us = cause_us, .cause_group = WindUpdate::info.answers.front()};
}

class WindReception final : public Reception {
 public:
  [[nodiscard]] bool takes(std::size_t message) const override { return WindGroup::has(message); }
  std::optional<Whole> take(const Frame& frame, std::size_t /*message*/, std::int64_t now_us,
                            checks::Observations& seen) override {
    return group_.put(frame) ? std::optional(add(group_, now_us, seen.of<WindAnswers>())) : std::nullopt;
  }

 private:
  WindGroup group_;
};

bool lies_within(const WindAnswer& answer, const world::GlideRecord& glide) {
  return answer.started && answer.cause_us >= 0 && answer.cause_us <= glide.end_us() &&
         answer.cause_us % world::GlideRecord::step_us == 0;
}

WindError error_of(const WindAnswer& answer, const world::GlideRecord& glide) {
  const world::GlideTruth& truth = glide.at(answer.cause_us);
  const Vector3 v = truth.C_bn * truth.v_a;
  const Eigen::Vector2d along = Eigen::Vector2d(v.x(), v.y()).normalized();
  const Vector3 error = answer.wind_n - truth.wind_n;
  return {.t_us = answer.cause_us,
          .error_n = error,
          .along_track = along.x() * error.x() + along.y() * error.y(),
          .cross_track = -along.y() * error.x() + along.x() * error.y()};
}

}  // namespace

std::unique_ptr<Reception> wind_reception() { return std::make_unique<WindReception>(); }

std::vector<WindError> wind_errors(const WindAnswers& answers, const world::GlideRecord& glide) {
  std::vector<WindError> errors;
  for (const WindAnswer& answer : answers) {
    if (lies_within(answer, glide)) errors.push_back(error_of(answer, glide));
  }
  return errors;
}

std::vector<Normalised> nis_of(const WindAnswers& answers) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : answers) {
    if (answer.outcome == messages::WindOutcome::updated) all.push_back({answer.cause_us, answer.nis});
  }
  return all;
}

std::vector<Normalised> nees_of(const WindAnswers& answers, const world::GlideRecord& glide) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : answers) {
    if (!lies_within(answer, glide)) continue;
    const Vector3 error = error_of(answer, glide).error_n;
    all.push_back({answer.cause_us, nees(error, answer.sigma, answer.correlation)});
  }
  return all;
}

}  // namespace canhil::estimators
