#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench schedulability FILE.dbc`: worst-case response times of all messages. Exit code 1 if one can
/// miss its deadline.
void add_schedulability(CLI::App& app, int& code);

}  // namespace canhil::commands
