// A program of the bench: the subcommands it has, and what it says of words that are none.
#pragma once

#include <span>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// Adds a subcommand to the program; `code` is its exit code, once it has run.
using AddCommand = void (*)(command_line::Command program, int& code);

/// Parses the command line, runs what it names, and returns the exit code.
int run_program(int argc, char** argv, std::span<const AddCommand> add_commands);

}  // namespace canhil::commands
