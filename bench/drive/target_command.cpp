#include "bench/drive/target_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "bench/processes/command.hpp"

namespace canhil::drive {
namespace {

namespace fs = std::filesystem;
using processes::program_path;

bool is_file(const fs::path& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

}  // namespace

Result<std::vector<std::string>> target_words(const std::string& command) {
  auto words = processes::words_of(command);
  if (!words) return failure(fmt::format("target '{}': {}", command, words.error().message));
  return words;
}

std::vector<std::string> files_of_target(const std::string& command) {
  std::vector<std::string> files;
  auto words = target_words(command);
  if (!words) return files;
  words->front() = program_path(words->front());
  for (const std::string& word : *words) {
    if (is_file(word) && std::ranges::find(files, word) == files.end()) files.push_back(word);
  }
  return files;
}

Result<void> check_target(const std::string& command) {
  const auto words = target_words(command);
  if (!words) return tl::unexpected(words.error());
  const std::string path = program_path(words->front());
  if (identify_file(path) && access(path.c_str(), X_OK) == 0) return {};
  return failure(
      fmt::format("target '{}': is not a program, expected the path of an executable file", words->front()));
}

}  // namespace canhil::drive
