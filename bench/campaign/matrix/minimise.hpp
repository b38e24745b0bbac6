// Minimises the scenario of a violation.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/campaign/matrix/matrix.hpp"

namespace canhil::campaign::matrix {

/// Whether a flight with these faults and this duration (0: as in the scenario file) violates the check.
using Shows = std::function<bool(const std::vector<FaultText>& faults, std::int64_t duration_us)>;

struct Minimised {
  std::vector<FaultText> faults{};
  std::int64_t duration_us = 0;  ///< 0: as in the scenario file
};

/// Minimises first the number of faults, then the duration, then, for each fault, the window and the number
/// of affected frames. `flown_us`: duration of the violating flight up to its end.
Minimised minimise(const std::vector<FaultText>& faults, std::int64_t flown_us, const Shows& shows);

}  // namespace canhil::campaign::matrix
