#include "bench/report/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>

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

Result<void> write_file(const std::string& path, std::string_view content) {
  // A name of its own: two runs that are told the same path must not write into one file.
  const std::string unfinished = fmt::format("{}.{}.part", path, getpid());
  std::FILE* file = std::fopen(unfinished.c_str(), "wb");
  if (file == nullptr) return complaint(path, errno);
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_error = errno;
  if (std::fclose(file) != 0 || !written) {
    const int error = written ? errno : write_error;
    std::remove(unfinished.c_str());
    return complaint(path, error);
  }
  if (std::rename(unfinished.c_str(), path.c_str()) != 0) {
    const int error = errno;
    std::remove(unfinished.c_str());
    return complaint(path, error);
  }
  return {};
}

Result<void> write(const std::string& path, std::string_view content) {
  return path == to_stdout ? write_stdout(content) : write_file(path, content);
}

Result<void> check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  if (path == to_stdout) return failure("file '-': standard output cannot hold this, expected a file");
  const fs::path folder = fs::absolute(path).parent_path();
  if (fs::is_directory(path)) return complaint(path, EISDIR);
  // The finished file takes the name's place: a device, a pipe or a link would be gone.
  if (fs::exists(fs::symlink_status(path)) && !fs::is_regular_file(fs::symlink_status(path))) {
    return failure(fmt::format("file '{}': is no regular file, expected one or a new name", path));
  }
  if (access(folder.c_str(), W_OK) != 0) return complaint(path, errno);
  return {};
}

Result<void> check_distinct(const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> seen;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    namespace fs = std::filesystem;
    const fs::path where = path == to_stdout ? fs::path(path) : fs::weakly_canonical(fs::absolute(path));
    if (std::ranges::find(seen, where) != seen.end()) {
      return failure(fmt::format("file '{}': is named twice, expected a file of its own for each", path));
    }
    seen.push_back(where);
  }
  return {};
}

}  // namespace canhil::report
