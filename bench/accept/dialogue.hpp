// Tests, command by command, whether the target handles the protocol correctly: whether the target executes
// and rejects commands as required.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"
#include "bench/accept/suite.hpp"

namespace canhil::accept {

/// The protocol requirements that every target must meet, whichever estimator it is.
std::vector<Requirement> protocol_requirements(const Suite& suite);

/// Starts the target and tests the protocol with the estimator that suite.dialogue selects. Returns an Error
/// if the target does not start.
Result<std::vector<Item>> talk(const Suite& suite, const std::string& target, const std::atomic<bool>& stop);

}  // namespace canhil::accept
