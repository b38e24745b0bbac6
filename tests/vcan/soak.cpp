// Sends frames through the port from one process to another on the same interface, for any time up to hours.
//   soak INTERFACE SECONDS [FRAMES_PER_S]
// The sender has an absolute deadline for each millisecond; after a stall of the host, the deadlines are
// moved. The sender receives the echo of its own frames, as the bench does. Sender and receiver check that no
// frame number is missing or out of order. The program prints ten lines of progress, then the result. It ends
// with 0 only if no frame was lost or reordered and the resident anonymous memory did not grow.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>

#include "dbc/ports/port.hpp"

namespace canhil {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t tick_ns = 1'000'000;
constexpr std::int64_t catch_up_ns = 100 * tick_ns;
constexpr std::int64_t patience_ns = 20 * ns_per_s;
constexpr std::uint32_t numbered_id = 0x123;
constexpr std::uint32_t last_id = 0x124;  // the last frame; it contains the number of frames that were sent
constexpr std::int64_t flat_kib =
    128;  // at 8000 frames/s, a leak of one byte per frame exceeds this limit within 17 s
constexpr int warm_up_part = 10;  // the warm-up is the first tenth of the duration

std::int64_t now_ns() { return clock_ns(CLOCK_MONOTONIC); }

[[noreturn]] void give_up(const std::string& why) {
  fmt::print("soak: {}\n", why);
  std::exit(1);
}

/// The resident anonymous memory. Pages of the program and its libraries are left out: they are loaded when
/// their code first runs, which is not a leak.
std::int64_t resident_kib() {
  std::ifstream file("/proc/self/statm");
  std::int64_t size = 0;
  std::int64_t resident = 0;
  std::int64_t of_files = 0;
  file >> size >> resident >> of_files;
  return (resident - of_files) * ::sysconf(_SC_PAGESIZE) / 1024;
}

std::uint64_t number_of(const Frame& frame) {
  std::uint64_t number = 0;
  std::memcpy(&number, frame.data.data(), sizeof number);
  return number;
}

/// Counts losses, repetitions and changes of order in the sequence 0, 1, 2 ...
class Tally {
 public:
  void add(std::uint64_t number) {
    ++received_;
    if (number < next_) {
      ++reordered_;
    } else {
      next_ = number + 1;
    }
  }
  [[nodiscard]] std::uint64_t received() const { return received_; }
  [[nodiscard]] std::uint64_t reordered() const { return reordered_; }
  [[nodiscard]] std::uint64_t lost(std::uint64_t sent) const { return sent - std::min(sent, received_); }

 private:
  std::uint64_t received_ = 0;
  std::uint64_t next_ = 0;
  std::uint64_t reordered_ = 0;
};

/// The resident memory at the end of the warm-up, and the largest resident memory since then.
class Memory {
 public:
  void look(bool warm) {
    const std::int64_t now_kib = resident_kib();
    if (!warm || warm_kib_ == 0) warm_kib_ = now_kib;
    most_kib_ = std::max(warm ? most_kib_ : 0, now_kib);
  }
  [[nodiscard]] bool flat() const { return most_kib_ - warm_kib_ <= flat_kib; }
  [[nodiscard]] std::string to_text() const {
    return fmt::format("{} KiB, at most {} KiB", warm_kib_, most_kib_);
  }

 private:
  std::int64_t warm_kib_ = 0;
  std::int64_t most_kib_ = 0;
};

std::unique_ptr<Port> open(const std::string& interface, bool own_echo) {
  auto port = open_port(interface, {.own_echo = own_echo});
  if (!port) give_up(port.error().message);
  return std::move(*port);
}

int verdict(std::string_view who, const Port& port, const Tally& tally, std::uint64_t sent,
            const Memory& memory) {
  fmt::print("{:<9} {} frames: {} lost, {} reordered, {} overflowed; resident {}\n", who, tally.received(),
             tally.lost(sent), tally.reordered(), port.counters().overflowed, memory.to_text());
  const bool good = sent > 0 && tally.lost(sent) == 0 && tally.reordered() == 0 && tally.received() == sent;
  return good && memory.flat() ? 0 : 1;
}

int receive(Port& port, std::int64_t duration_ns) {
  Tally tally;
  Memory memory;
  const std::int64_t warm_ns = now_ns() + duration_ns / warm_up_part;
  std::int64_t look_ns = 0;
  for (std::int64_t heard_ns = now_ns();;) {
    while (const auto received = port.receive()) {
      if (received->frame.error) continue;
      if (received->frame.id == last_id)
        return verdict("receiver", port, tally, number_of(received->frame), memory);
      tally.add(number_of(received->frame));
    }
    const std::int64_t now = now_ns();
    if (now >= look_ns) {
      memory.look(now >= warm_ns);
      look_ns = now + ns_per_s / 10;
    }
    if (!wait(port, WaitFor::frame, heard_ns + patience_ns)) give_up("nothing came any more");
    heard_ns = now;
  }
}

void send(Port& port, std::uint32_t id, std::uint64_t number) {
  Frame frame{.id = id, .size = 8};
  std::memcpy(frame.data.data(), &number, sizeof number);
  while (port.send(frame) != SendOutcome::sent)
    if (!wait(port, WaitFor::room, now_ns() + patience_ns)) give_up("no room any more");
}

int send(Port& port, std::int64_t duration_ns, std::int64_t rate) {
  Tally echoes;
  Memory memory;
  std::uint64_t sent = 0;
  std::int64_t latest_ns = 0;  // largest lateness of the sender
  const auto drain = [&] {
    while (const auto received = port.receive())
      if (received->own && received->frame.id == numbered_id) echoes.add(number_of(received->frame));
  };
  const std::int64_t start_ns = now_ns();
  const std::int64_t end_ns = start_ns + duration_ns;
  std::int64_t line_ns = start_ns + duration_ns / 10;
  std::int64_t due_ns = start_ns;
  for (std::int64_t tick = 1; now_ns() < end_ns; ++tick, due_ns += tick_ns) {
    while (now_ns() < due_ns) {
      wait(port, WaitFor::frame, due_ns);
      drain();
    }
    const std::int64_t late_ns = now_ns() - due_ns;
    latest_ns = std::max(latest_ns, late_ns);
    if (late_ns > catch_up_ns) due_ns += late_ns;  // the bus could not catch up after such a stall
    for (const auto due = static_cast<std::uint64_t>(tick * rate * tick_ns / ns_per_s); sent < due; ++sent)
      send(port, numbered_id, sent);
    drain();
    if (now_ns() < line_ns) continue;
    memory.look(true);
    fmt::print("{:>7.1f} s  {:>10} frames  {:>10} echoes  {} reordered  resident {} KiB\n",
               static_cast<double>(now_ns() - start_ns) * 1e-9, sent, echoes.received(), echoes.reordered(),
               resident_kib());
    line_ns += duration_ns / 10;
  }
  const double took_s = static_cast<double>(now_ns() - start_ns) * 1e-9;
  for (const std::int64_t deadline_ns = now_ns() + patience_ns;
       echoes.received() < sent && wait(port, WaitFor::frame, deadline_ns);)
    drain();
  send(port, last_id, sent);
  fmt::print("{} frames in {:.1f} s: {:.0f} frames/s of {} asked for; sender at most {:.1f} ms late\n", sent,
             took_s, static_cast<double>(sent) / took_s, rate, static_cast<double>(latest_ns) * 1e-6);
  return verdict("sender", port, echoes, sent, memory);
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) {
  using namespace canhil;
  if (argc != 3 && argc != 4) give_up("expected INTERFACE SECONDS [FRAMES_PER_S]");
  const std::int64_t duration_ns = std::atoll(argv[2]) * ns_per_s;
  const std::int64_t rate = argc == 4 ? std::atoll(argv[3]) : 8000;
  if (duration_ns <= 0 || rate <= 0) give_up("expected SECONDS and FRAMES_PER_S above 0");
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const auto receiving = open(argv[1], false);  // opened before the fork, so that it misses no frame
  const pid_t child = ::fork();
  if (child == 0) return receive(*receiving, duration_ns);
  int code = 0;
  {
    const auto sending = open(argv[1], true);
    code = send(*sending, duration_ns, rate);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const bool good = code == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  fmt::print("soak: {}\n", good ? "nothing lost, nothing reordered, memory flat" : "FAILED");
  return good ? 0 : 1;
}
