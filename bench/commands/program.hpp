// A program of the bench: the subcommands it has, what it says of words that are none, and the programs that
// it goes on as: who flies single runs need not build campaigns with their statistics, nor who flies
// campaigns the papers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// Adds a subcommand to the program; `code` is its exit code, once it has run.
using AddCommand = void (*)(command_line::Command program, int& code);

/// Runs what main is to do. What is thrown, such as that there is no memory, ends with one line and exit code
/// 2; a file at its size limit is an error of write(), not a signal.
int guarded(const std::function<int()>& run);

/// Parses the command line, runs what it names, and returns the exit code.
int run_program(int argc, char** argv, std::span<const AddCommand> add_commands);

/// Where this program lies.
std::string own_folder();

/// The project's own data, "flights" or "acceptance": installed, share/canhil beside this program's bin; else
/// in the source tree that it was built from.
std::string data_folder(const std::string& name);

/// Replaces this process by a program beside it, with these words for its command line (without its name).
/// Returns only where that cannot be started: the exit code, after one line that says why.
int become(const std::string& program, std::vector<std::string> words);

}  // namespace canhil::commands
