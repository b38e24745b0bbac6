// A command that the user gives as text: a program and its arguments.
#pragma once

#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::processes {

/// The words of a command: "python3 my_target.py --gain 3". Blanks separate words, as in a shell; '...' and
/// "..." keep a word together, and \ takes the next character literally. Variables and patterns are not
/// expanded. Error, one phrase after the command: there is no word, or a quote is not closed.
Result<std::vector<std::string>> words_of(const std::string& command);

/// Quotes a path as one word of a command.
std::string quoted_word(const std::string& path);

/// The file that the first word of a command starts in a working folder (empty: that of the bench). If the
/// word contains a '/' or is a file in the folder, this is the word itself. For other words, this is the
/// program that PATH leads to. If PATH leads to no program, the function returns the word unchanged.
std::string program_path(const std::string& word, const std::string& folder = "");

}  // namespace canhil::processes
