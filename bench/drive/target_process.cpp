#include "bench/drive/target_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bench/drive/target_command.hpp"
#include "dbc/realtime/process.hpp"

namespace canhil::drive {

Result<TargetProcess> TargetProcess::start(const std::string& command, const std::string& bus,
                                           const std::vector<std::string>& more,
                                           const std::vector<int>& cpus) {
  auto words = target_words(command);
  if (!words) return tl::unexpected(words.error());
  const std::string name = words->front(), program = program_path(name);
  const auto no_program = [&name](int reason) {
    return failure(fmt::format("target '{}': {}; expected an executable file, or --target none", name,
                               strerror(reason)));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(program, ignored))
    return no_program(EISDIR);  // execv would report EACCES
  words->insert(words->end(), {"--bus", bus});
  words->insert(words->end(), more.begin(), more.end());
  std::vector<char*> arguments;
  for (std::string& word : *words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // Through this pipe the new process reports why the program did not start. If the program starts, the pipe
  // closes.
  int refusal[2];
  if (pipe2(refusal, O_CLOEXEC) != 0)
    return failure(fmt::format("target '{}': cannot start a process: {}", name, strerror(errno)));
  const pid_t parent = getpid();
  const pid_t pid = fork();
  const int fork_error = errno;
  if (pid != 0) close(refusal[1]);
  if (pid < 0) {
    close(refusal[0]);
    return failure(fmt::format("target '{}': cannot start a process: {}", name, strerror(fork_error)));
  }
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    std::signal(SIGPIPE, SIG_DFL);  // the target must not inherit the bench's signal settings
    if (getppid() != parent) _exit(127);
    if (!cpus.empty()) realtime::pin(cpus);
    dup2(STDERR_FILENO,
         STDOUT_FILENO);  // standard output belongs to the bench, which may write a report to it
    execv(program.c_str(), arguments.data());
    const int reason = errno;
    static_cast<void>(!write(refusal[1], &reason, sizeof reason));
    _exit(127);
  }
  int reason = 0;
  ssize_t got = 0;
  do {
    got = read(refusal[0], &reason, sizeof reason);
  } while (got < 0 && errno == EINTR);
  close(refusal[0]);
  if (got == static_cast<ssize_t>(sizeof reason)) {
    waitpid(pid, nullptr, 0);
    return no_program(reason);
  }
  return TargetProcess(pid);
}

TargetProcess::TargetProcess(TargetProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), ended_(std::move(other.ended_)) {}

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

bool TargetProcess::stopped() const {
  siginfo_t info{};
  return pid_ >= 0 && !ended_ &&
         waitid(P_PID, static_cast<id_t>(pid_), &info, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

void TargetProcess::send_signal(int signal) {
  if (pid_ >= 0 && !ended()) kill(pid_, signal);
}

void TargetProcess::kill_it() {
  if (pid_ < 0 || ended()) return;
  kill(pid_, SIGKILL);
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
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

}  // namespace canhil::drive
