#include "bench/papers/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace canhil::papers {
namespace {

// A file in memory, used as a standard stream of the child process: unlike a pipe, it cannot fill up and
// block.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("gnuplot", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] bool put(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(descriptor_, text.data(), text.size());
      if (written <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    return lseek(descriptor_, 0, SEEK_SET) == 0;
  }
  [[nodiscard]] std::string content() const {
    std::string text;
    std::array<char, 65536> block{};
    lseek(descriptor_, 0, SEEK_SET);
    for (ssize_t n = 0; (n = read(descriptor_, block.data(), block.size())) > 0;)
      text.append(block.data(), static_cast<std::size_t>(n));
    return text;
  }

 private:
  int descriptor_;
};

auto not_started(int error) {
  return failure(fmt::format("gnuplot: cannot be started ({}), expected Debian's package gnuplot-nox",
                             std::strerror(error)));
}

std::string first_line(const std::string& text) {
  const auto begin = text.find_first_not_of("\n\r \t");
  if (begin == std::string::npos) return "no message";
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

Result<std::string> gnuplot(std::string_view script) {
  const MemoryFile in, out, complaints;
  if (in.descriptor() < 0 || out.descriptor() < 0 || complaints.descriptor() < 0 || !in.put(script))
    return not_started(errno);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, complaints.descriptor(), STDERR_FILENO);
  std::string program = "gnuplot";
  std::string from_stdin = "-";
  const std::array<char*, 3> arguments{program.data(), from_stdin.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &streams, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) return not_started(error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0)
    return failure(
        fmt::format("gnuplot: ended with status {}: {}", status, first_line(complaints.content())));
  return out.content();
}

Result<void> check_gnuplot() {
  const auto drawn = gnuplot("set terminal svg\nplot x\n");
  if (!drawn) return tl::unexpected(drawn.error());
  return {};
}

}  // namespace canhil::papers
