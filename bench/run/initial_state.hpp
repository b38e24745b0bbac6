// What the target is told of its state at the start, as the messages of group TargetInit.
#pragma once

#include <tuple>

#include "bench/scenario/target_setup.hpp"
#include "bench/world/navigation_errors.hpp"
#include "messages/canhil.hpp"

namespace canhil::run {

/// Group TargetInit in the order of transmission.
using InitialState =
    std::tuple<messages::TargetInitLatitude, messages::TargetInitLongitude, messages::TargetInitVelocityNE,
               messages::TargetInitAttitude, messages::TargetInitSigma, messages::TargetInitVelocityD>;

InitialState initial_state(const world::NavigationSolution& initial, const scenario::InitialSigma& sigma);

}  // namespace canhil::run
