#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench campaign FILE` and its subcommands merge, report, replay: many runs in process, and statistics.
void add_campaign(CLI::App& app, int& code);

}  // namespace canhil::commands
