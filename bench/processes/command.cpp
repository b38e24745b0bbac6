#include "bench/processes/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace canhil::processes {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

bool needs_no_quotes(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_-./+,:=@%").find(c) != std::string_view::npos;
}

}  // namespace

Result<std::vector<std::string>> words_of(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    const bool blank = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && blank) {
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (quote != 0 && c == quote) {
      quote = 0;
    } else if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      words.back() += command[++i];
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) return failure(fmt::format("a quote ({}) has no end, expected a second one", quote));
  if (words.empty() || words.front().empty())
    return failure("has no word, expected a program and its arguments");
  return words;
}

std::string quoted_word(const std::string& path) {
  if (!path.empty() && std::ranges::all_of(path, needs_no_quotes)) return path;
  std::string word = "'";
  for (const char c : path) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string program_path(const std::string& word, const std::string& folder) {
  if (word.find('/') != std::string::npos || is_file(fs::path(folder) / word)) return word;
  const char* path = std::getenv("PATH");
  std::istringstream places(path == nullptr ? "" : path);
  for (std::string place; std::getline(places, place, ':');) {
    std::string found = place + "/" + word;
    if (is_file(found) && access(found.c_str(), X_OK) == 0) return found;
  }
  return word;
}

}  // namespace canhil::processes
