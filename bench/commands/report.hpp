// hil-bench report and hil-bench compare: what is done with reports of finished runs.
#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// Adds both subcommands; they set `code`.
void add_report(command_line::Command app, int& code);

}  // namespace canhil::commands
