#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench diverge A B`: the first frame of the target in which two recorded runs differ. Exit code 1 if
/// they do.
void add_diverge(CLI::App& app, int& code);

}  // namespace canhil::commands
