#include "bench/report/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

namespace canhil::report {
namespace {

auto complaint(const std::string& path, int error) {
  return failure(fmt::format("file '{}': cannot be written: {}", path, std::strerror(error)));
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view content) {
  const std::string unfinished = path + ".part";
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

Result<void> check_writable(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (std::filesystem::is_directory(path)) return complaint(path, EISDIR);
  if (access(folder.c_str(), W_OK) != 0) return complaint(path, errno);
  return {};
}

}  // namespace canhil::report
