#include "bench/checks/los.hpp"

#include <cmath>

namespace canhil::checks {

std::vector<LosError> los_errors(const Observations& seen, const world::EngagementRecord& engagement) {
  std::vector<LosError> errors;
  errors.reserve(seen.los.size());
  for (const LosAnswer& answer : seen.los) {
    const world::EngagementTruth* truth = engagement.at(answer.cause_us);
    if (truth == nullptr || !tells_rate(answer.outcome)) continue;
    errors.push_back({.t_us = answer.cause_us,
                      .time_to_go = truth->time_to_go(),
                      .rate = {.pitch = answer.rate.pitch - truth->los_rate.pitch,
                               .yaw = answer.rate.yaw - truth->los_rate.yaw}});
  }
  return errors;
}

std::vector<Normalised> los_nis(const Observations& seen) {
  std::vector<Normalised> series;
  for (const LosAnswer& answer : seen.los) {
    if (updated(answer.outcome)) series.push_back({answer.cause_us, answer.nis});
  }
  return series;
}

std::optional<double> los_rms(const std::vector<LosError>& errors, double least, double most) {
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

}  // namespace canhil::checks
