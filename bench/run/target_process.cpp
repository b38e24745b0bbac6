#include "bench/run/target_process.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstring>

#include <utility>

#include "dbc/realtime/process.hpp"

namespace canhil::run {

Result<TargetProcess> TargetProcess::start(const std::string& program, const std::string& bus,
                                           const std::vector<std::string>& more,
                                           const std::vector<int>& cpus) {
  if (access(program.c_str(), X_OK) != 0) {
    return failure(fmt::format("target '{}': {}; expected an executable file, or --target none", program,
                               strerror(errno)));
  }
  std::vector<std::string> words{program, "--bus", bus};
  words.insert(words.end(), more.begin(), more.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0)
    return failure(fmt::format("target '{}': cannot start a process: {}", program, strerror(errno)));
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    if (!cpus.empty()) realtime::pin(cpus);
    execv(program.c_str(), arguments.data());
    _exit(127);
  }
  return TargetProcess(pid);
}

TargetProcess::TargetProcess(TargetProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), ended_(std::move(other.ended_)) {}

TargetProcess& TargetProcess::operator=(TargetProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(ended_, other.ended_);
  return *this;
}

TargetProcess::~TargetProcess() {
  if (pid_ < 0 || ended()) return;
  kill(pid_, SIGTERM);
  for (int i = 0; i < 100; ++i) {
    if (ended()) return;
    usleep(5000);
  }
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<std::string> TargetProcess::ended() {
  int status = 0;
  if (pid_ >= 0 && !ended_ && waitpid(pid_, &status, WNOHANG) == pid_) {
    ended_ = WIFSIGNALED(status)
                 ? fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
                 : fmt::format("exited with {}", WEXITSTATUS(status));
  }
  return ended_;
}

}  // namespace canhil::run
