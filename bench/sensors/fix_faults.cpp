#include "bench/sensors/fix_faults.hpp"

#include <cmath>
#include <numbers>

namespace canhil::sensors {

using scenario::Limits;

// The sum of an outlier of this size, the distance to the ship and all errors fits into SsblRelativeNE, the
// message with the smallest range.
constexpr double largest_outlier_m = 50'000;

FixFaults read_fix_faults(scenario::Section& section) {
  const Limits share = Limits::between(0, 100);
  FixFaults faults{
      .loss_probability = section.number({"loss_percent", "Share of the fixes that are not sent."}, share, 0),
      .invalid_probability =
          section.number({"invalid_percent", "Share of the fixes that are sent as invalid."}, share, 0),
      .outlier_probability = section.number(
          {"outlier_percent", "Share of the fixes that jump by `outlier_m`. Needs `outlier_m`."}, share, 0),
      .outlier = section.number(
          {"outlier_m", "Size of a jump, in a random horizontal direction. Needs `outlier_percent`."},
          Limits::between(0, largest_outlier_m), 0),
      .silence_us = {}};
  // outlier_m is allowed beside an explicit outlier_percent of 0, because a sweep may begin with 0.
  const bool size_alone = faults.outlier > 0 && !section.has("outlier_percent");
  if (size_alone || (faults.outlier_probability > 0 && faults.outlier <= 0)) {
    section.reject(faults.outlier > 0 ? "outlier_m" : "outlier_percent", "is given alone",
                   "outlier_percent and outlier_m, both above 0");
  }
  faults.silence_us = section.optional_interval_us(
      {"silence_s", "Fixes with a time of validity in this interval are not sent."}, Limits::at_least(0));
  return faults;
}

Fate draw_fate(const FixFaults& faults, std::int64_t valid_us, world::Stream& stream) {
  const bool lost = stream.uniform() < faults.loss_probability;
  const bool invalid = stream.uniform() < faults.invalid_probability;
  const bool outlier = stream.uniform() < faults.outlier_probability;
  const double direction = 2.0 * std::numbers::pi * stream.uniform();
  const bool silent =
      faults.silence_us && valid_us >= faults.silence_us->first && valid_us <= faults.silence_us->second;
  Fate fate{.lost = lost || silent, .invalid = invalid};
  if (outlier) fate.jump = faults.outlier * world::Vector3(std::cos(direction), std::sin(direction), 0);
  return fate;
}

}  // namespace canhil::sensors
