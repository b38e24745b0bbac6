#include "bench/scenario/fix_faults.hpp"

#include <cmath>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

// Together with the way of a ship and its errors within the range of SsblRelativeNE, which is the narrowest.
constexpr double largest_outlier_m = 50'000;

FixFaults read_fix_faults(Section& section) {
  const Limits share = Limits::between(0, 100);
  FixFaults faults{.loss_probability = section.number("loss_percent", share, 0),
                   .invalid_probability = section.number("invalid_percent", share, 0),
                   .outlier_probability = section.number("outlier_percent", share, 0),
                   .outlier = section.number("outlier_m", Limits::between(0, largest_outlier_m), 0),
                   .silence_us = {}};
  // A share of 0 that is given stands at the beginning of a sweep.
  const bool size_alone = faults.outlier > 0 && !section.has("outlier_percent");
  if (size_alone || (faults.outlier_probability > 0 && faults.outlier <= 0)) {
    section.reject(faults.outlier > 0 ? "outlier_m" : "outlier_percent", "is given alone",
                   "outlier_percent and outlier_m, both above 0");
  }
  if (section.has("silence_s")) {
    const auto [from, to] = section.interval("silence_s", Limits::at_least(0));
    faults.silence_us = {std::llround(from * 1e6), std::llround(to * 1e6)};
  }
  section.optional("silence_s");
  return faults;
}

}  // namespace canhil::scenario
