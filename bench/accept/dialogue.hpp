// Tests the target's handling of the protocol command by command: required actions and required rejections.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"
#include "bench/accept/suite.hpp"

namespace canhil::accept {

/// Requirements for every target, whatever it estimates.
std::vector<Requirement> protocol_requirements(const Suite& suite);

/// Starts the target and tests it as the estimator of suite.dialogue. Error: the target does not start.
Result<std::vector<Item>> talk(const Suite& suite, const std::string& target, const std::atomic<bool>& stop);

}  // namespace canhil::accept
