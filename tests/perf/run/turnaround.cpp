// Measures the turnaround of the target and of an echo. The turnaround is the time from the last frame of a
// stimulus to the last frame of its answer. The echo is a process that computes nothing: it sends the
// recorded answer to each stimulus.
//   turnaround [--flights N] [--only NAME] [--bus BUS ECHO_BUS]
// Target and echo are on different buses, so that neither receives the frames of the other. These buses are
// two embedded buses or, with --bus, two CAN interfaces of the same kind. For every estimator and each
// message that ends an answer, the program prints p50, p99 and maximum of both turnarounds, the numbers of
// missing answers, and the ratios of the turnarounds.
//
// Target and echo take turns in blocks, so that other load of the machine affects both equally. The flight is
// sent faster than real time. This is possible because the target computes its answers from the times in the
// frames, not from a clock.
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/drive/target_process.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/ports/local_bus.hpp"
#include "tests/perf/run/flight_rounds.hpp"

namespace canhil {
namespace {

constexpr std::size_t block = 200;  // rounds per block
constexpr std::int64_t patience_ns = 1'000'000'000;
constexpr int most_unanswered = 10;
constexpr std::int64_t breath = 8;  // the pause after a block lasts 1/8 of the time of the block, because
                                    // Linux stops real-time processes that use a whole CPU

struct Estimator {
  std::string name;
  std::string scenario;
  std::string algorithm;
  int flights = 1;
};

const std::vector<Estimator> estimators{
    {"LOS rate", "los_quick", "combined", 20},
    {"transfer alignment KF", "transfer_alignment", "kalman", 5},
    {"transfer alignment H2", "transfer_alignment_h2", "robust_h2", 5},
    {"in-flight UKF", "inflight_gps", "ukf", 2},
    {"in-flight EKF", "inflight_gps", "ekf", 2},
    {"wind EKF", "wind_ekf", "ekf", 2},
    {"wind H-infinity", "wind_h_infinity", "h_infinity", 2},
};

int complain(const std::string& what) {
  fmt::print(stderr, "turnaround: {}\n", what);
  return 2;
}

/// The functions of the echo: one reads a frame, one writes an answer, each with as few system calls as the
/// bus allows.
struct Bare {
  std::function<void()> read;
  std::function<void(std::span<const Frame>)> write;
};

Bare bare_node(const std::string& bus) {
  if (bus.starts_with("local:")) {
    auto joined = join_local_bus(bus, {});
    if (!joined) ::_exit(complain(joined.error().message));
    const std::shared_ptr<Port> node = std::move(*joined);
    ::fcntl(node->descriptor(), F_SETFL, ::fcntl(node->descriptor(), F_GETFL) & ~O_NONBLOCK);
    return {[node] {
              if (!node->receive()) ::_exit(0);
            },
            [node](std::span<const Frame> frames) { static_cast<void>(node->send_all(frames)); }};
  }
  const int socket = ::socket(AF_CAN, SOCK_RAW, CAN_RAW);
  sockaddr_can at{};
  at.can_family = AF_CAN;
  at.can_ifindex = static_cast<int>(::if_nametoindex(bus.c_str()));
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0)
    ::_exit(complain("cannot bind"));
  return {[socket] {
            can_frame frame{};
            if (::read(socket, &frame, sizeof frame) < 0) ::_exit(1);
          },
          [socket](std::span<const Frame> frames) {
            for (const Frame& frame : frames) {
              can_frame raw{};
              raw.can_id = frame.id;
              raw.len = frame.size;
              std::memcpy(raw.data, frame.data.data(), frame.size);
              static_cast<void>(::write(socket, &raw, sizeof raw));
            }
          }};
}

[[noreturn]] void echo(const std::string& bus, const std::vector<Round>& rounds) {
  const Bare node = bare_node(bus);
  const Frame ready{.id = messages::TargetHeartbeat::info.id, .size = 8};
  node.write({&ready, 1});
  for (const Round& round : rounds) {
    for (std::size_t n = 0; n < round.stimulus.size(); ++n) node.read();
    node.write(round.answers);
  }
  ::pause();
  ::_exit(0);
}

/// The turnaround times of all answers whose last frame is a certain message.
struct Times {
  std::vector<std::int64_t> ns;
  int unanswered = 0;
};
using TimesByAnswer = std::map<std::uint32_t, Times>;

/// One side of the comparison: the program that answers on this bus.
class Side {
 public:
  explicit Side(Port& port) : port_(port) {}

  /// Reads and discards the remaining frames.
  void settle() {
    for (int empty = 0; empty < 2;) empty = port_.receive() ? 0 : empty + 1;
  }

  bool hears(std::uint32_t id) {
    const std::int64_t deadline_ns = clock_ns(CLOCK_MONOTONIC) + patience_ns;
    while (clock_ns(CLOCK_MONOTONIC) < deadline_ns) {
      while (const auto received = port_.receive()) {
        if (received->frame.id == id) return true;
      }
      wait(port_, WaitFor::frame, deadline_ns);
    }
    return false;
  }

  void play(const Round& round, bool count) {
    std::int64_t sent_ns = 0;
    for (const Frame& frame : round.stimulus) {
      sent_ns = clock_ns(CLOCK_MONOTONIC);
      while (port_.send(frame) == SendOutcome::queue_full) wait(port_, WaitFor::room, no_deadline);
    }
    const std::uint32_t last = round.answers.back().id;
    const bool answered = hears(last);
    const std::int64_t took_ns = clock_ns(CLOCK_MONOTONIC) - sent_ns;
    unanswered_ += answered ? 0 : 1;
    if (!answered) ++times[last].unanswered;
    if (answered && count) times[last].ns.push_back(took_ns);
  }
  [[nodiscard]] bool alive() const { return unanswered_ < most_unanswered; }

  TimesByAnswer times;

 private:
  Port& port_;
  int unanswered_ = 0;
};

Result<std::unique_ptr<Port>> open_here(const std::string& bus) {
  if (!bus.starts_with("local:")) return open_port(bus, {});
  auto hub = host_local_bus(bus, {});
  if (!hub) return tl::unexpected(hub.error());
  return std::move(*hub);
}

void rest(std::int64_t since_ns) {
  ::usleep(static_cast<unsigned>((clock_ns(CLOCK_MONOTONIC) - since_ns) / breath / 1000));
}

/// Sends the rounds to both sides in blocks. Each block goes to the echo first, and then to the target. The
/// first block is a warm-up.
void alternate(const std::vector<Round>& rounds, Side& device, Side& bare) {
  for (std::size_t first = 0; first < rounds.size() && device.alive() && bare.alive(); first += block) {
    const std::size_t end = std::min(first + block, rounds.size());
    for (Side* side : {&bare, &device}) {
      const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
      for (std::size_t k = first; k < end; ++k) side->play(rounds[k], first > 0);
      rest(start_ns);
    }
  }
}

Result<void> fly(const std::vector<Round>& rounds, const std::vector<std::string>& buses, Side& device,
                 Side& bare) {
  // Discards the frames of earlier processes that are still queued, so that nobody takes them for new frames.
  device.settle();
  bare.settle();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close_range(3, ~0U, 0);
    echo(buses[1], rounds);
  }
  auto target = drive::start_target(HIL_TARGET, buses[0]);
  if (!target) return tl::unexpected(target.error());
  const bool ready =
      bare.hears(messages::TargetHeartbeat::info.id) && device.hears(messages::TargetHeartbeat::info.id);
  if (ready) alternate(rounds, device, bare);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  if (!ready) return failure("target or echo do not come up");
  if (!device.alive() || !bare.alive())
    return failure(fmt::format("{} does not answer", device.alive() ? "the echo" : "the target"));
  return {};
}

double us(const std::vector<std::int64_t>& sorted, double quantile) {
  const double rank = std::ceil(quantile * static_cast<double>(sorted.size()));
  return 1e-3 * static_cast<double>(sorted[static_cast<std::size_t>(rank) - 1]);
}

std::string_view message_of(std::uint32_t id) {
  return std::ranges::find(messages::all_messages, id, &MessageInfo::id)->name;
}

bool by_an_estimator(std::uint32_t id) {
  return !std::ranges::find(messages::all_messages, id, &MessageInfo::id)->answers.empty();
}

void print(const Estimator& estimator, TimesByAnswer& device, TimesByAnswer& bare) {
  constexpr std::size_t enough = 100;
  for (auto& [id, own] : device) {
    Times& echo = bare[id];
    if (own.ns.size() < enough || echo.ns.size() < enough || !by_an_estimator(id)) continue;
    std::ranges::sort(own.ns);
    std::ranges::sort(echo.ns);
    fmt::print("{:<22} {:<15}{:>7}", estimator.name, message_of(id), own.ns.size());
    for (const Times* times : {&own, &echo})
      fmt::print(" |{:>8.1f}{:>8.1f}{:>9.1f}{:>3}", us(times->ns, 0.5), us(times->ns, 0.99), us(times->ns, 1),
                 times->unanswered);
    fmt::print(" |{:>6.2f}{:>6.2f}{:>6.2f}\n", us(own.ns, 0.5) / us(echo.ns, 0.5),
               us(own.ns, 0.99) / us(echo.ns, 0.99), us(own.ns, 1) / us(echo.ns, 1));
  }
  std::fflush(stdout);
}

int compare(int flights, const std::string& only, const std::vector<std::string>& buses) {
  auto port = open_here(buses[0]), echo_port = open_here(buses[1]);
  if (!port) return complain(port.error().message);
  if (!echo_port) return complain(echo_port.error().message);
  fmt::print(
      "turnaround [us]                          rounds |       of hil-target            |        of a bare "
      "echo          |      ratio\n"
      "estimator              answer ends with       |     p50     p99      max  ? |     p50     p99      "
      "max  ? |   p50   p99   max"
      "   (?: unanswered)\n");
  for (const Estimator& estimator : estimators) {
    if (!estimator.name.starts_with(only)) continue;
    Side device(**port), bare(**echo_port);
    for (int flight = 0; flight < estimator.flights * flights; ++flight) {
      const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
      const auto rounds =
          record_flight(fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, estimator.scenario),
                        estimator.algorithm, static_cast<std::uint64_t>(flight));
      if (!rounds) return complain(rounds.error().message);
      rest(start_ns);
      if (auto flown = fly(*rounds, buses, device, bare); !flown)
        return complain(estimator.name + ": " + flown.error().message);
    }
    print(estimator, device.times, bare.times);
  }
  return 0;
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) {
  canhil::command_line::Program program{"Turnaround of hil-target beside that of a bare echo."};
  std::optional<int> flights;
  std::string only;
  const std::string local = fmt::format("local:turnaround-{}", ::getpid());
  std::vector<std::string> buses{local, local + "-echo"};
  program.add_number("--flights", flights, "how many times as many as it takes", 1, 1000);
  program.add_option("--only", only, "estimators whose name begins so");
  program.add_option("--bus", buses, "of the target and of the echo: two CAN interfaces").words(2);
  const auto parsed = program.parse(argc, argv);
  if (!parsed) std::fprintf(stderr, "run_turnaround: %s; see --help\n", parsed.error().message.c_str());
  if (!parsed || *parsed) return parsed ? **parsed : 2;
  return canhil::compare(flights.value_or(1), only, buses);
}
