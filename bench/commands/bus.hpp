#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench bus local:NAME`: hosts an embedded bus for other programs until interrupted.
void add_bus(command_line::Command app, int& code);

}  // namespace canhil::commands
