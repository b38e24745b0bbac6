// Before a run: find the target, make sure it was built from the same DBC, configure it, start it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "bench/drive/initial_state.hpp"
#include "bench/drive/link.hpp"
#include "bench/nodes/node.hpp"
#include "bench/scenario/target_setup.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// Waits for the target's heartbeat and checks its DBC hash; selects each estimator, sets and reads back its
/// parameters, sends its initial state with its sigmas; starts them all. Each step is repeated until it is
/// acknowledged. A target that is observe::heard in the other format than the bus's `format` is named as
/// such. `initial` is in the order of `estimators`. `gone` says why there is no point in waiting any more, if
/// so ("target: exited with 1"). Error: one line.
Result<void> configure(Link& link, nodes::Transmission& out,
                       std::span<const scenario::TargetSetup> estimators,
                       std::span<const InitialState> initial,
                       const std::function<std::optional<std::string>()>& gone,
                       BusFormat format = BusFormat::classic);

/// Stops the estimators, and waits a moment for the heartbeat of each that says so: they belong to the
/// session's record.
void stop(Link& link, nodes::Transmission& out, std::span<const scenario::TargetSetup> estimators);

}  // namespace canhil::drive
