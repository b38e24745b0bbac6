// `hil-bench run` with several scenarios: a process for each, one page and one JUnit file for all.
#pragma once

#include "bench/commands/exit_code.hpp"
#include "bench/commands/run_options.hpp"

namespace canhil::commands {

/// Whether the arguments are those of several scenarios, or of a selection or a folder.
bool are_many(const RunArguments& arguments);

/// Flies the scenarios, as many at once as asked for, and prints a line for each. Nothing flies if a scenario
/// or an option is wrong. Returns the worst exit code: usage, fail, not measured, pass.
ExitCode run_many(const RunArguments& arguments);

}  // namespace canhil::commands
