// Checks of single kinds: whether their signals can carry every value of a run (Kind::fits).
#pragma once

#include "bench/nodes/kind.hpp"

namespace canhil::nodes {

Result<void> slave_imu_fits(const NodeSettings& node, const scenario::Scenario& scenario,
                            const world::FlightRecord& flight);
Result<void> seeker_fits(const NodeSettings& node, const scenario::Scenario& scenario,
                         const world::FlightRecord& flight);

}  // namespace canhil::nodes
