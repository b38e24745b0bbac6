#include "dbc/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace canhil {
namespace {

// O_EXCL: fails if anything, even a link without a target, has this name.
constexpr int as_new_file = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
constexpr mode_t by_umask = 0666;

auto complaint(const std::string& path, int error) {
  return failure(fmt::format("file '{}': cannot be written: {}", path, std::strerror(error)));
}

}  // namespace

Result<OutputFile> OutputFile::create(const std::string& path) {
  std::uint64_t random = 0;
  if (getrandom(&random, sizeof random, 0) != sizeof random) return complaint(path, errno);
  std::string name = fmt::format("{}.{:016x}.part", path, random);
  const int descriptor = open(name.c_str(), as_new_file, by_umask);
  if (descriptor < 0) return complaint(path, errno);
  return OutputFile(descriptor, std::move(name));
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      temporary_name_(std::exchange(other.temporary_name_, {})) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_name_.empty()) std::remove(temporary_name_.c_str());
}

std::FILE* OutputFile::take_stream() {
  std::FILE* stream = fdopen(descriptor_, "wb");
  if (stream != nullptr) descriptor_ = -1;
  return stream;
}

int OutputFile::give_name(const std::string& name) {
  if (std::rename(temporary_name_.c_str(), name.c_str()) != 0) return errno;
  temporary_name_.clear();
  return 0;
}

Result<void> write_file(const std::string& path, const std::function<void(const Sink&)>& content) {
  return write_file_unless_failed(path, [&](const Sink& give) -> Result<void> {
    content(give);
    return {};
  });
}

Result<void> write_file_unless_failed(const std::string& path,
                                      const std::function<Result<void>(const Sink&)>& content) {
  auto output = OutputFile::create(path);
  if (!output) return tl::unexpected(output.error());
  std::FILE* file = output->take_stream();
  if (file == nullptr) return complaint(path, errno);
  // The first error is reported.
  int error = 0;
  Result<void> complete = content([&](std::string_view part) {
    if (error == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) error = errno;
  });
  if (std::fclose(file) != 0 && error == 0) error = errno;
  if (!complete) return complete;
  if (error == 0) error = output->give_name(path);
  return error == 0 ? Result<void>() : complaint(path, error);
}

Result<void> write_file(const std::string& path, std::string_view content) {
  return write_file(path, [&](const Sink& give) { give(content); });
}

Result<void> check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  if (fs::is_directory(path, unknown)) return complaint(path, EISDIR);
  // The finished file is renamed to this name. The renaming would destroy a device, a pipe or a link.
  const fs::file_status there = fs::symlink_status(path, unknown);
  if (fs::exists(there) && !fs::is_regular_file(there))
    return failure(fmt::format("file '{}': is not a regular file, expected one or a new name", path));
  // Only creating a file proves that it is possible: root has write permission in /proc, but cannot create
  // files there.
  return OutputFile::create(path).map([](const OutputFile&) {});
}

Result<void> create_new_file(const std::string& path) {
  const int descriptor = open(path.c_str(), as_new_file, by_umask);
  if (descriptor < 0) return complaint(path, errno);
  close(descriptor);
  return {};
}

}  // namespace canhil
