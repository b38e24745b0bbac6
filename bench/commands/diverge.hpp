#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench diverge A B`: the first frame of the target in which two recorded runs differ. Exit code 1 if
/// they do.
void add_diverge(command_line::Command app, int& code);

}  // namespace canhil::commands
