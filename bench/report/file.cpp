#include "bench/report/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "dbc/files/unfinished_name.hpp"

namespace canhil::report {
namespace {

auto complaint(const std::string& path, int error) {
  return failure(fmt::format("file '{}': cannot be written: {}", path, std::strerror(error)));
}

}  // namespace

Result<void> write_stdout(std::string_view content) {
  const bool written = std::fwrite(content.data(), 1, content.size(), stdout) == content.size();
  if (written && std::fflush(stdout) == 0) return {};
  return failure(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

Result<void> write_file(const std::string& path, const std::function<void(const Sink&)>& content) {
  const std::string unfinished = unfinished_name(path);
  std::FILE* file = std::fopen(unfinished.c_str(), "wb");
  if (file == nullptr) return complaint(path, errno);
  // The first error is reported.
  int error = 0;
  content([&](std::string_view part) {
    if (error == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) error = errno;
  });
  if (std::fclose(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(unfinished.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return {};
  std::remove(unfinished.c_str());
  return complaint(path, error);
}

Result<void> write_file(const std::string& path, std::string_view content) {
  return write_file(path, [&](const Sink& give) { give(content); });
}

Result<void> write(const std::string& path, std::string_view content) {
  return path == to_stdout ? write_stdout(content) : write_file(path, content);
}

Result<void> check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  if (path == to_stdout) return failure("file '-': standard output cannot hold this, expected a file");
  std::error_code unknown;
  if (fs::is_directory(path, unknown)) return complaint(path, EISDIR);
  // The finished file is renamed to this name. The renaming would destroy a device, a pipe or a link.
  const fs::file_status there = fs::symlink_status(path, unknown);
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    return failure(fmt::format("file '{}': is not a regular file, expected one or a new name", path));
  }
  // Only creating a file proves that it is possible: root has write permission in /proc, but cannot create
  // files there.
  const std::string unfinished = unfinished_name(path);
  const int file = open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return complaint(path, errno);
  close(file);
  std::remove(unfinished.c_str());
  return {};
}

Result<void> check_distinct(const std::vector<std::string>& paths) {
  namespace fs = std::filesystem;
  std::vector<fs::path> seen;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    // A path without a canonical form (a pipe, a missing folder) is compared as given.
    std::error_code unknown;
    fs::path where = fs::absolute(path, unknown);
    if (!unknown) where = fs::weakly_canonical(where, unknown);
    if (unknown || path == to_stdout) where = path;
    if (std::ranges::find(seen, where) != seen.end()) {
      return failure(fmt::format("file '{}': is named twice, expected a file of its own for each", path));
    }
    seen.push_back(std::move(where));
  }
  return {};
}

}  // namespace canhil::report
