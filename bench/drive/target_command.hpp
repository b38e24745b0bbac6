// Parses `--target`: a program and its arguments.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/drive/file_identity.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// The words of a target's command: "python3 my_target.py --gain 3". Blanks separate words, as in a shell;
/// '...' and "..." keep a word together, and \ takes the next character literally. Variables and patterns are
/// not expanded. Error, one line: there is no word, or a quote is not closed.
Result<std::vector<std::string>> target_words(const std::string& command);

/// Quotes a path as one word of a target's command.
std::string quoted_word(const std::string& path);

/// The file that the first word of a command starts. If the word contains a '/' or is a file in the current
/// folder, this is the word itself. For other words, this is the program that PATH leads to. If PATH leads to
/// no program, the function returns the word unchanged.
std::string program_path(const std::string& word);

/// The regular files in a command, the program first, without duplicates: the program and all arguments that
/// are files.
std::vector<std::string> files_of_target(const std::string& command);

/// Checks that a command can be started. Error, one line: the command cannot be split, or its first word is
/// not an executable file.
Result<void> check_target(const std::string& command);

}  // namespace canhil::drive
