// What `--target` says: a program and its arguments.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/drive/file_identity.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// The words of a target's command: "python3 my_target.py --gain 3". Blanks divide them, as in a shell; '...'
/// and "..." hold a word together, and \ takes the next character as it is. Nothing else has a meaning: no
/// variables, no patterns. Error: one line; no word, or a quote without its end.
Result<std::vector<std::string>> target_words(const std::string& command);

/// A path as one word of such a command.
std::string quoted_word(const std::string& path);

/// The file that a command's first word starts: the word itself if it has a '/' or is a file here, else as
/// PATH finds it; the word where that has none.
std::string program_path(const std::string& word);

/// The regular files that a command names, its program first, each once: the file that is started, and the
/// arguments that are files.
std::vector<std::string> files_of_target(const std::string& command);

/// Error: a command that cannot be split, or whose first word is no executable file, in one line.
Result<void> check_target(const std::string& command);

}  // namespace canhil::drive
