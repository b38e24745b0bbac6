#include "dbc/files/command_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>
#include <utility>

#include "dbc/files/output_file.hpp"

namespace canhil {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view standard_output = "-";

// The deepest existing part of a path, and the names below it. The rest is empty if the file exists.
using Place = std::tuple<dev_t, ino_t, std::string>;

std::optional<Place> place_of(const std::string& path) {
  std::error_code unknown;
  fs::path there = fs::absolute(path, unknown), rest;
  for (;;) {
    struct stat status {};
    if (stat(there.c_str(), &status) == 0)
      return Place(status.st_dev, status.st_ino, rest.lexically_normal().string());
    if (!there.has_relative_path()) return std::nullopt;
    rest = rest.empty() ? there.filename() : there.filename() / rest;
    there = there.parent_path();
  }
}

}  // namespace

CommandFiles::CommandFiles() {
  std::error_code unknown;
  reads("program", fs::read_symlink("/proc/self/exe", unknown).string());
}

void CommandFiles::reads(std::string role, std::string path) {
  if (!path.empty()) inputs_.push_back({std::move(role), std::move(path)});
}

void CommandFiles::reads(const std::vector<File>& files) {
  for (const File& file : files) reads(file.role, file.path);
}

void CommandFiles::writes(std::string role, std::string path) {
  const bool to_stdout = path == standard_output;
  if (!path.empty()) outputs_.push_back({.file = {std::move(role), std::move(path)}, .to_stdout = to_stdout});
}

void CommandFiles::writes_file(std::string role, std::string path) {
  if (!path.empty()) outputs_.push_back({.file = {std::move(role), std::move(path)}});
}

void CommandFiles::may_write(std::string role, std::string path) {
  if (!path.empty()) outputs_.push_back({.file = {std::move(role), std::move(path)}, .certain = false});
}

Result<void> CommandFiles::check_distinct() const {
  std::map<Place, const File*> taken;
  for (const File& input : inputs_) {
    if (const auto place = place_of(input.path)) taken.emplace(*place, &input);
  }
  const File* on_stdout = nullptr;
  for (const auto& [file, to_stdout, certain] : outputs_) {
    if (to_stdout) {
      if (on_stdout != nullptr)
        return failure(fmt::format("{} -, {} -: both to standard output, expected only one of them",
                                   on_stdout->role, file.role));
      on_stdout = &file;
      continue;
    }
    const auto place = place_of(file.path);
    if (!place) continue;
    const auto [other, is_new] = taken.emplace(*place, &file);
    if (is_new) continue;
    return failure(fmt::format("{} '{}': is the same file as {} '{}', expected another file", file.role,
                               file.path, other->second->role, other->second->path));
  }
  return {};
}

Result<void> CommandFiles::check_writable() const {
  for (const auto& [file, to_stdout, certain] : outputs_) {
    if (to_stdout || !certain) continue;
    if (file.path == standard_output)
      return failure(fmt::format("{} -: standard output cannot hold this, expected a file", file.role));
    if (auto writable = canhil::check_writable(file.path); !writable) return writable;
  }
  return {};
}

Result<void> CommandFiles::check() const {
  auto distinct = check_distinct();
  return distinct ? check_writable() : distinct;
}

Result<void> check_distinct_inputs(const std::vector<std::string>& paths) {
  std::map<Place, const std::string*> seen;
  for (const std::string& path : paths) {
    const auto place = place_of(path);
    if (place && !seen.emplace(*place, &path).second)
      return failure(fmt::format("file '{}': is named twice, expected different files", path));
  }
  return {};
}

}  // namespace canhil
