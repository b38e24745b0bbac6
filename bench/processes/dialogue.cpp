#include "bench/processes/dialogue.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <utility>

namespace canhil::processes {
namespace {

struct Pipe {
  Descriptor read_end, write_end;
};

std::optional<Pipe> make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  return Pipe{Descriptor(ends[0]), Descriptor(ends[1])};
}

// The bench must not wait in read() or write(). The program's own ends are not affected.
bool never_waits(const Descriptor& own_end) { return fcntl(own_end.get(), F_SETFL, O_NONBLOCK) == 0; }

// Waits until the descriptor can be read or written, or has been closed by the other side.
bool ready(const Descriptor& descriptor, short events, Dialogue::Time deadline) {
  using namespace std::chrono;
  while (true) {
    const auto now = steady_clock::now();
    const nanoseconds left = deadline > now ? deadline - now : nanoseconds::zero();
    const auto whole = duration_cast<seconds>(left);
    const timespec timeout{.tv_sec = whole.count(), .tv_nsec = (left - whole).count()};
    pollfd one{.fd = descriptor.get(), .events = events, .revents = 0};
    const int found = ppoll(&one, 1, &timeout, nullptr);
    if (found > 0) return true;
    if (found == 0 || errno != EINTR) return false;
  }
}

}  // namespace

Result<Dialogue> Dialogue::start(const std::string& program, std::vector<std::string> words,
                                 StartOptions options) {
  std::signal(SIGPIPE, SIG_IGN);
  auto in = make_pipe(), out = make_pipe();
  if (!in || !out || !never_waits(in->write_end) || !never_waits(out->read_end))
    return failure(strerror(errno));
  options.input = in->read_end.get();
  options.output = out->write_end.get();
  auto process = ChildProcess::start(program, std::move(words), options);
  if (!process) return tl::unexpected(process.error());
  return Dialogue(std::move(*process), std::move(in->write_end), std::move(out->read_end));
}

Result<Dialogue> Dialogue::over(Descriptor connection) {
  std::signal(SIGPIPE, SIG_IGN);
  Descriptor other(fcntl(connection.get(), F_DUPFD_CLOEXEC, 0));
  if (other.get() < 0 || !never_waits(connection)) return failure(strerror(errno));
  return Dialogue(std::nullopt, std::move(other), std::move(connection));
}

Dialogue::Outcome Dialogue::send_some(std::string_view& bytes, Time deadline) {
  while (!bytes.empty()) {
    const ssize_t sent = write(to_program_.get(), bytes.data(), bytes.size());
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN) {
      if (!ready(to_program_, POLLOUT, deadline)) return Outcome::late;
    } else if (errno != EINTR) {
      return Outcome::closed;
    }
  }
  return Outcome::done;
}

Dialogue::Outcome Dialogue::receive(std::string& received, Time deadline, std::size_t most) {
  const std::size_t before = received.size();
  while (true) {
    received.resize(before + most);
    const ssize_t got = read(from_program_.get(), received.data() + before, most);
    const int reason = errno;
    received.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got > 0) return Outcome::done;
    if (got == 0 || (reason != EAGAIN && reason != EINTR)) return Outcome::closed;
    if (reason == EAGAIN && !ready(from_program_, POLLIN, deadline)) return Outcome::late;
  }
}

}  // namespace canhil::processes
