#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench bus local:NAME`: hosts an embedded bus for other programs until interrupted.
void add_bus(CLI::App& app, int& code);

}  // namespace canhil::commands
