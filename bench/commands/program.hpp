// Functions that the bench's programs share: they run subcommands, report unknown words, and start one
// program from another. The programs are separate so that single runs do not link campaigns and their
// statistics, and campaigns do not link the papers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// Adds a subcommand to the program. `code` receives the exit code after the subcommand has run.
using AddCommand = void (*)(command_line::Command program, int& code);

/// Runs the body of main. An exception, such as lack of memory, ends the program with one line and exit code
/// 2. If a file reaches its size limit, write() returns an error, and no signal ends the program.
int guarded(const std::function<int()>& run);

/// Parses the command line, runs the selected subcommand, and returns the exit code.
int run_program(int argc, char** argv, std::span<const AddCommand> add_commands);

/// The folder that contains this program.
std::string own_folder();

/// The folder of the project's data: `name` is "flights" or "acceptance". If the program is installed, the
/// data are in share/canhil beside the folder bin of this program; otherwise they are in the source tree.
std::string data_folder(const std::string& name);

/// Replaces this process by a program in the same folder, with `words` as the arguments of that program.
/// Returns only if that program cannot be started: prints the reason in one line and returns the exit code.
int become(const std::string& program, std::vector<std::string> words);

}  // namespace canhil::commands
