// hil-bench report and hil-bench compare: what is done with reports of finished runs.
#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// Adds both subcommands; they set `code`.
void add_report(CLI::App& app, int& code);

}  // namespace canhil::commands
