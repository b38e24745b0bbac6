#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench schedulability FILE.dbc`: worst-case response times of all messages. Exit code 1 if one can
/// miss its deadline.
void add_schedulability(command_line::Command app, int& code);

}  // namespace canhil::commands
