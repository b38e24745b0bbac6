// Parses `--target`: a program and its arguments.
#pragma once

#include <string>
#include <vector>

#include "bench/drive/file_identity.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// The words of a target's command (processes::words_of()). Error, one line: the command cannot be split.
Result<std::vector<std::string>> target_words(const std::string& command);

/// The regular files in a command, the program first, without duplicates: the program and all arguments that
/// are files.
std::vector<std::string> files_of_target(const std::string& command);

/// Checks that a command can be started. Error, one line: the command cannot be split, or its first word is
/// not an executable file.
Result<void> check_target(const std::string& command);

}  // namespace canhil::drive
