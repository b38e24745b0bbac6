#include "bench/processes/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "dbc/realtime/process.hpp"

namespace canhil::processes {
namespace {

ProcessEnd end_of(const siginfo_t& info) {
  if (info.si_code == CLD_EXITED) return {.status = info.si_status};
  return {.signal = info.si_status};
}

// Connects the standard input and output of the new process. The descriptors are first copied to numbers
// that dup2() does not overwrite: a bench that was started without a standard input has pipes with the
// numbers 0 and 1.
void connect_streams(const StartOptions& options) {
  constexpr int after_standard_streams = 3;
  const auto copied = [](int descriptor) {
    return fcntl(descriptor, F_DUPFD_CLOEXEC, after_standard_streams);
  };
  const int input = options.input < 0 ? -1 : copied(options.input);
  const int output = copied(options.output < 0 ? STDERR_FILENO : options.output);
  if (input >= 0) dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
}

void be_ordinary() {
  if (sched_getscheduler(0) == SCHED_OTHER) return;  // the CPUs are those that the user gave
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);
  cpu_set_t all;
  std::memset(&all, 0xFF, sizeof all);
  sched_setaffinity(0, sizeof all, &all);
}

}  // namespace

std::string to_text(const ProcessEnd& end) {
  if (end.signal == 0) return fmt::format("exited with {}", end.status);
  const char* name = sigabbrev_np(end.signal);
  return name == nullptr ? fmt::format("ended by signal {}", end.signal)
                         : fmt::format("ended by SIG{} ({})", name, sigdescr_np(end.signal));
}

Result<ChildProcess> ChildProcess::start(const std::string& program, std::vector<std::string> words,
                                         const StartOptions& options) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // If a process of the group outlives its parent, it becomes a child of the bench instead of a child of
  // init, so that end() can wait for it.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  // Through this pipe the new process reports why the program did not start. If the program starts, the pipe
  // closes.
  int refusal[2];
  if (pipe2(refusal, O_CLOEXEC) != 0) return failure(strerror(errno));
  const pid_t parent = getpid();
  const pid_t pid = fork();
  const int fork_error = errno;
  if (pid != 0) close(refusal[1]);
  if (pid < 0) {
    close(refusal[0]);
    return failure(strerror(fork_error));
  }
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, options.signal_at_death);
    if (getppid() != parent) _exit(127);
    std::signal(SIGPIPE, SIG_DFL);  // the program must not inherit the bench's signal settings
    setsid();
    if (!options.cpus.empty()) realtime::pin(options.cpus);
    if (options.ordinary) be_ordinary();
    connect_streams(options);
    if (options.folder.empty() || chdir(options.folder.c_str()) == 0)
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
  ChildProcess child(pid);
  if (got == static_cast<ssize_t>(sizeof reason)) {
    std::error_code ignored;
    const bool folder =
        std::filesystem::is_directory(std::filesystem::path(options.folder) / program, ignored);
    return failure(strerror(folder ? EISDIR : reason));  // for a folder, execv() fails with EACCES
  }
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      reaped_(std::exchange(other.reaped_, true)),
      ended_(other.ended_) {}

ChildProcess::~ChildProcess() {
  if (pid_ >= 0) end(short_patience);
}

// The process is only looked at here, not reaped: until reap(), the kernel gives its number to no other
// process or group.
std::optional<ProcessEnd> ChildProcess::ended() {
  siginfo_t info{};
  if (!ended_ && waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
      info.si_pid == pid_)
    ended_ = end_of(info);
  return ended_;
}

bool ChildProcess::stopped() const {
  siginfo_t info{};
  return !ended_ && waitid(P_PID, static_cast<id_t>(pid_), &info, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

void ChildProcess::send_signal(int signal) {
  if (!reaped_) kill(-pid_, signal);
}

// Returns whether neither the process nor another process of its group is left.
bool ChildProcess::reap() {
  if (!ended()) return false;
  while (!reaped_) {
    const pid_t one = waitpid(-pid_, nullptr, WNOHANG);
    if (one == 0) return false;
    reaped_ = one < 0 && errno == ECHILD;
  }
  return true;
}

void ChildProcess::leave() {
  if (!std::exchange(reaped_, true)) waitpid(pid_, nullptr, 0);
}

ProcessEnd ChildProcess::end(std::chrono::milliseconds patience) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds between_looks{2};
  const auto wait_until = [&](steady_clock::time_point deadline) {
    while (!reap() && steady_clock::now() < deadline) std::this_thread::sleep_for(between_looks);
  };
  if (!reap()) {
    send_signal(SIGTERM);
    send_signal(SIGCONT);  // a stopped process handles SIGTERM only after this signal
    wait_until(steady_clock::now() + patience);
  }
  if (!reap()) {
    const bool ended_itself = ended().has_value();
    send_signal(SIGKILL);
    wait_until(steady_clock::now() + short_patience);
    if (!ended_) ended_ = ProcessEnd{.signal = SIGKILL};  // the kernel does not let it go, for example in I/O
    ended_->killed = !ended_itself;
  }
  return *ended_;
}

}  // namespace canhil::processes
