#include "bench/checks/los.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/checks/silence.hpp"
#include "bench/world/units.hpp"

namespace canhil::checks {
namespace {

using scenario::LosPlane;
using world::units::mrad;

bool has(LosPlane asked, LosPlane plane) { return asked == LosPlane::both || asked == plane; }

bool inside(const LosError& error, double least, double most) {
  return error.time_to_go >= least && error.time_to_go < most;
}

}  // namespace

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

std::optional<double> los_rms(const std::vector<LosError>& errors, double least, double most,
                              LosPlane plane) {
  double squares = 0;
  int count = 0;
  for (const LosError& error : errors) {
    if (!inside(error, least, most)) continue;
    if (has(plane, LosPlane::pitch)) squares += error.rate.pitch * error.rate.pitch;
    if (has(plane, LosPlane::yaw)) squares += error.rate.yaw * error.rate.yaw;
    count += plane == LosPlane::both ? 2 : 1;
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / count);
}

Finding judge(const scenario::LosRateError& rule, const Observations& seen,
              const world::EngagementRecord* engagement) {
  const bool rms = rule.statistic == scenario::LosStatistic::rms;
  const std::string expected =
      fmt::format("{} < {:g} mrad/s from {:g} to {:g} s to go", rms ? "RMS" : "|error|", rule.below / mrad,
                  rule.most_to_go, rule.least_to_go);
  if (engagement == nullptr) return {Outcome::fail, "no engagement", expected};
  const std::vector<LosError> errors = los_errors(seen, *engagement);
  const auto flown = std::ranges::count_if(engagement->epochs, [&](const world::EngagementTruth& epoch) {
    return epoch.time_to_go() >= rule.least_to_go && epoch.time_to_go() < rule.most_to_go;
  });
  double worst = 0;
  std::ptrdiff_t answered = 0;
  for (const LosError& error : errors) {
    if (!inside(error, rule.least_to_go, rule.most_to_go)) continue;
    ++answered;
    if (has(rule.plane, LosPlane::pitch)) worst = std::max(worst, std::abs(error.rate.pitch));
    if (has(rule.plane, LosPlane::yaw)) worst = std::max(worst, std::abs(error.rate.yaw));
  }
  if (flown == 0) return {Outcome::fail, "the flight has no samples there", expected};
  if (answered == 0) return {Outcome::fail, "no answers", expected};
  if (static_cast<double>(answered) < least_answered * static_cast<double>(flown))
    return {Outcome::fail, fmt::format("answers to {} of {} samples", answered, flown), expected};
  const double value = rms ? los_rms(errors, rule.least_to_go, rule.most_to_go, rule.plane).value() : worst;
  return {pass_if(value < rule.below),
          fmt::format("{} {:.3f} mrad/s of {}", rms ? "RMS" : "max", value / mrad, answered), expected};
}

Finding judge(const scenario::MissDistance& rule, const world::EngagementRecord* engagement) {
  const std::string expected = fmt::format("miss < {:g} m", rule.below);
  if (engagement == nullptr || !engagement->miss_n)
    return {Outcome::fail, "the missile did not pass the target before the end", expected};
  const double miss = engagement->miss_n->norm();
  return {pass_if(miss < rule.below), fmt::format("{:.3f} m", miss), expected};
}

}  // namespace canhil::checks
