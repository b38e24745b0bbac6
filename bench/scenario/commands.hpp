// The shell commands of a scenario.
#pragma once

#include "dbc/wire/result.hpp"

namespace canhil::scenario {

struct Scenario;

/// Error, one line: the scenario has a shell command, `before` or `after`, which a run would execute.
Result<void> refuse_commands(const Scenario& scenario);

}  // namespace canhil::scenario
