#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench run SCENARIO`: one run and its verdict. Leaves the exit code in `code`.
void add_run(command_line::Command app, int& code);

}  // namespace canhil::commands
