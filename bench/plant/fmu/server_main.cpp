// hil-bench-fmu: runs an FMU in a process of its own. The bench starts it, with a socket as standard input.
// What the FMU prints goes to standard error. An empty record ends the program. If the bench dies, the
// program ends too, and removes the folder of the FMU in its place.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <thread>

#include "bench/plant/fmu/channel.hpp"
#include "bench/plant/fmu/running.hpp"

namespace {

using namespace canhil;
using namespace canhil::plant::fmu;

/// The folder of the FMU; the thread that removes it and the thread that sets it share it.
class Folder {
 public:
  void set(const std::string& path) {
    const std::lock_guard lock(mutex_);
    path_ = path;
  }
  void remove() {
    const std::lock_guard lock(mutex_);
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }

 private:
  std::mutex mutex_;
  std::string path_;
};

// When the bench dies, the kernel sends SIGTERM. This thread waits for the signal, so it also arrives while
// the FMU hangs. The kernel sends it too when only the bench's thread ends that started this process: then
// the parent is still the bench.
void watch_the_bench(Folder& folder, pid_t bench) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // the FMU's thread and all later ones inherit this
  std::thread([&folder, bench, signals] {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0 || getppid() == bench) {
    }
    folder.remove();
    _exit(1);
  }).detach();
}

/// Takes the socket away from standard input, so that an FMU that reads its standard input finds it empty.
int take_socket() {
  const int socket = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  close(nothing);
  return socket;
}

void answer(const Channel& channel, const Result<void>& done, std::span<const double> outputs) {
  Writer writer;
  writer.add(done.has_value());
  if (done)
    writer.add(outputs);
  else
    writer.add(done.error().message);
  channel.send(writer.bytes());
}

/// Returns false if the bench died.
bool serve(const Channel& channel, Folder& folder) {
  std::string record;
  if (channel.receive(record) != Channel::Outcome::done) return false;
  RecordReader first(record);
  const Setup setup = read_setup(first);
  folder.set(setup.folder);
  std::vector<double> inputs(elements_of(setup.inputs)), outputs(elements_of(setup.outputs));
  const auto running = start_here(setup, outputs);
  answer(channel, running ? Result<void>() : tl::unexpected(running.error()), outputs);
  while (channel.receive(record) == Channel::Outcome::done) {
    if (record.empty()) return true;
    if (!running) continue;
    RecordReader reader(record);
    const auto from_s = reader.take<double>(), step_s = reader.take<double>();
    reader.take(inputs);
    answer(channel, (*running)->step(from_s, step_s, inputs, outputs), outputs);
  }
  return false;
}

}  // namespace

int main() {
  int kind = 0;
  socklen_t size = sizeof kind;
  if (getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &kind, &size) != 0) {
    fmt::print(stderr,
               "hil-bench-fmu: its standard input is no socket, expected to be started by hil-bench\n");
    return 2;
  }
  static Folder& folder = *new Folder;  // never deleted: the watching thread uses it until the process ends
  watch_the_bench(folder, getppid());
  if (serve(Channel(take_socket()), folder)) return 0;
  folder.remove();
  return 1;
}
