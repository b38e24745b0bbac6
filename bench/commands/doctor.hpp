#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench doctor --bus BUS`: what this machine and its interface can do, with remedies. Exit code 1 if
/// something is bad.
void add_doctor(command_line::Command app, int& code);

}  // namespace canhil::commands
