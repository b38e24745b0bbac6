// Minimises the scenario of a violation.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/fault_matrix/plan.hpp"

namespace canhil::fault_matrix {

/// Whether a flight with these faults and this duration (0: the file's) violates the check.
using Shows = std::function<bool(const std::vector<FaultText>& faults, std::int64_t duration_us)>;

struct Minimised {
  std::vector<FaultText> faults{};
  std::int64_t duration_us = 0;  ///< 0: the file's
};

/// First the fewest faults, then the shortest flight, then for each fault the shortest window and the fewest
/// frames. `flown_us`: how far the violating flight went.
Minimised minimise(const std::vector<FaultText>& faults, std::int64_t flown_us, const Shows& shows);

}  // namespace canhil::fault_matrix
