// What the bench's programs share: subcommands, messages for unknown words, and starting one program from
// another. The programs are separate so that single runs do not link campaigns and their statistics, and
// campaigns do not link the papers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// Adds a subcommand to the program. `code` receives the exit code when the subcommand has run.
using AddCommand = void (*)(command_line::Command program, int& code);

/// Runs the body of main. An exception, such as lack of memory, ends the program with one line and exit code
/// 2; a file at its size limit is an error of write(), not a signal.
int guarded(const std::function<int()>& run);

/// Parses the command line, runs the selected subcommand, and returns the exit code.
int run_program(int argc, char** argv, std::span<const AddCommand> add_commands);

/// The folder of this program.
std::string own_folder();

/// The folder of the project's data, "flights" or "acceptance": if installed, share/canhil beside this
/// program's bin; otherwise in the source tree of the build.
std::string data_folder(const std::string& name);

/// Replaces this process by a program in the same folder, with these words as the arguments of that program.
/// Returns only if that program cannot be started: the exit code, after one line with the reason.
int become(const std::string& program, std::vector<std::string> words);

}  // namespace canhil::commands
