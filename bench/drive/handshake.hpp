// The handshake before a run: find the target, check its DBC hash, configure it, start it.
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
/// parameters, sends its initial state with sigmas; then starts all estimators. Each step is repeated until
/// it is acknowledged. Reports a target that answers in a format other than `format`. `initial` is in the
/// order of `estimators`. `gone`: if waiting for the target is pointless, returns the reason ("target: exited
/// with 1"). Error: one line.
Result<void> configure(Link& link, nodes::Transmission& out,
                       std::span<const scenario::TargetSetup> estimators,
                       std::span<const InitialState> initial,
                       const std::function<std::optional<std::string>()>& gone,
                       BusFormat format = BusFormat::classic);

/// Stops the estimators. Waits briefly for the heartbeats that confirm the stop, so that the session's log
/// contains these heartbeats.
void stop(Link& link, nodes::Transmission& out, std::span<const scenario::TargetSetup> estimators);

}  // namespace canhil::drive
