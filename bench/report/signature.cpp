#include "bench/report/signature.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <vector>

namespace canhil::report {
namespace {

// Runs a program with a file as standard input, without its output. Returns its exit status; none: it cannot
// be started.
std::optional<int> status_of(std::vector<std::string> words, const std::string& input) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&streams, output, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments.front(), &streams, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) return std::nullopt;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string line_about(const std::string& file, const std::string& signature, const std::string& program,
                       std::optional<int> status, const std::string& who) {
  if (!status)
    return fmt::format("{}: the signature {} is not checked: {} cannot be started", file, signature, program);
  if (*status == 0)
    return fmt::format("{}: the signature {} covers it; {} tells whose it is", file, signature, who);
  return fmt::format("{}: the signature {} does NOT cover it, or its key is not known: {} tells more", file,
                     signature, who);
}

}  // namespace

std::string signature_line(const std::string& file) {
  std::error_code unknown;
  const auto there = [&](const std::string& path) { return std::filesystem::is_regular_file(path, unknown); };
  // A leading './' keeps a name that begins with '-' from being an option.
  const std::string path = file.starts_with('-') ? "./" + file : file;
  if (const std::string signature = path + ".sig"; there(signature))
    return line_about(
        file, signature, "ssh-keygen",
        status_of({"ssh-keygen", "-Y", "check-novalidate", "-n", "canhil-report", "-s", signature}, path),
        "ssh-keygen -Y verify");
  if (const std::string signature = path + ".asc"; there(signature))
    return line_about(file, signature, "gpg",
                      status_of({"gpg", "--batch", "--verify", signature, path}, "/dev/null"),
                      "gpg --verify");
  return fmt::format(
      "{}: no signature covers it (there is no {}.sig or .asc); its hashes find damage, not forgery", file,
      file);
}

}  // namespace canhil::report
