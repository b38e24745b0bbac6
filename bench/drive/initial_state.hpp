// The initial state that the bench sends to the target.
#pragma once

#include <optional>
#include <tuple>

#include "bench/nodes/node.hpp"
#include "bench/scenario/target_setup.hpp"
#include "bench/world/navigation_errors.hpp"
#include "dbc/wire/result.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {

/// Group TargetInit, in the order of transmission.
using InitialNavigation =
    std::tuple<messages::TargetInitLatitude, messages::TargetInitLongitude, messages::TargetInitVelocityNE,
               messages::TargetInitAttitude, messages::TargetInitSigma, messages::TargetInitVelocityD>;
/// Group TargetInitAir.
using InitialAir = std::tuple<messages::TargetInitRate, messages::TargetInitAirVelocity>;

struct InitialState {
  std::optional<InitialAir> air;  ///< for a glider; sent first, because TargetInit makes the target ready
  InitialNavigation navigation;
};

InitialState initial_state(const world::NavigationSolution& initial, const scenario::InitialSigma& sigma);

/// The group TargetInitAir. `rates` [rad/s] and `air_velocity` (velocity through the air, in m/s) are in body
/// axes.
InitialAir initial_air(const world::Vector3& rates, const world::Vector3& air_velocity);

/// Appends the messages to `out`. The group that makes the target ready comes last.
void send(const InitialState& state, nodes::Transmission& out);

/// Checks that every value lies within its signal's range. Also checks, for each signal that cannot be
/// negative, that the value is either 0 or at least the resolution of the signal. Without these checks,
/// values would be saturated or rounded to zero unnoticed. Error: one line.
Result<void> check_fits(const InitialState& state);

}  // namespace canhil::drive
