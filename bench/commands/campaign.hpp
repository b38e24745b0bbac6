#pragma once

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// `hil-bench campaign FILE` and its subcommands merge, report, replay: many runs in process, and statistics.
void add_campaign(command_line::Command app, int& code);

}  // namespace canhil::commands
