#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench run SCENARIO`: one run and its verdict. Leaves the exit code in `code`.
void add_run(CLI::App& app, int& code);

}  // namespace canhil::commands
