#pragma once

#include <CLI/CLI.hpp>

namespace canhil::commands {

/// `hil-bench doctor --bus BUS`: what this machine and its interface can do, with remedies. Exit code 1 if
/// something is bad.
void add_doctor(CLI::App& app, int& code);

}  // namespace canhil::commands
