#include "bench/nodes/fix_faults.hpp"

#include <cmath>
#include <numbers>

namespace canhil::nodes {

Fate draw_fate(const scenario::FixFaults& faults, std::int64_t valid_us, world::Stream& stream) {
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

}  // namespace canhil::nodes
