#include "bench/checks/wind.hpp"

namespace canhil::checks {
namespace {

using world::Vector3;

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

std::vector<WindError> wind_errors(const Observations& seen, const world::GlideRecord& glide) {
  std::vector<WindError> errors;
  for (const WindAnswer& answer : seen.wind) {
    if (lies_within(answer, glide)) errors.push_back(error_of(answer, glide));
  }
  return errors;
}

std::vector<Normalised> wind_nis(const Observations& seen) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : seen.wind) {
    if (answer.outcome == messages::WindOutcome::updated) all.push_back({answer.cause_us, answer.nis});
  }
  return all;
}

std::vector<Normalised> wind_nees(const Observations& seen, const world::GlideRecord& glide) {
  std::vector<Normalised> all;
  for (const WindAnswer& answer : seen.wind) {
    if (!lies_within(answer, glide)) continue;
    const Vector3 error = error_of(answer, glide).error_n;
    all.push_back({answer.cause_us, nees(error, answer.sigma, answer.correlation)});
  }
  return all;
}

}  // namespace canhil::checks
