// Checks of single kinds: whether their signals can carry every value of a run (Kind::fits).
#pragma once

#include "bench/nodes/kind.hpp"

namespace canhil::nodes {

Result<void> slave_imu_fits(const NodeSettings& node, const scenario::Scenario& scenario,
                            const world::FlightRecord& flight);
Result<void> seeker_fits(const NodeSettings& node, const scenario::Scenario& scenario,
                         const world::FlightRecord& flight);

/// The check of the sensor with this key; null: it needs none.
constexpr decltype(Kind::fits) fits_of(std::string_view key) {
  return key == "slave_imu" ? slave_imu_fits : key == "seeker" ? seeker_fits : nullptr;
}

}  // namespace canhil::nodes
