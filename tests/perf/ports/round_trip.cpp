// Measures round trips between two processes over two paths, in one run of the program. One path is the
// embedded bus, the other path is a bare SOCK_SEQPACKET socketpair.
//   round_trip [ROUNDS [LIMIT]]: prints p50, p99 and maximum of both paths, and the ratios. With LIMIT, the
//   program fails if the ratio of the two p50 is larger than LIMIT.
//
// On both paths, the processes wait in the same manner: they read the socket, and call poll() if it is empty.
// The program measures a block of rounds on one path, then a block on the other path, and so on, so that
// other load of the machine affects both paths equally.
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <functional>

#include "dbc/ports/local_bus.hpp"

namespace canhil {
namespace {

constexpr int block = 1000;
constexpr std::size_t bare_bytes = 24;  // as large as the embedded bus's datagram for a frame of 8 bytes

Frame ping() {
  Frame frame;
  frame.id = 0x123;
  frame.size = 8;
  return frame;
}

void bare_send(int socket) {
  const std::array<char, bare_bytes> datagram{};
  if (::send(socket, datagram.data(), datagram.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) std::exit(1);
}

bool bare_receive(int socket) {  // false: the peer has closed the connection
  std::array<char, bare_bytes> datagram{};
  for (;;) {
    const ssize_t bytes = ::recv(socket, datagram.data(), datagram.size(), MSG_DONTWAIT);
    if (bytes >= 0) return bytes > 0;
    pollfd entry{.fd = socket, .events = POLLIN, .revents = 0};
    ::ppoll(&entry, 1, nullptr, nullptr);
  }
}

bool bus_receive(Port& port) {
  while (!port.closed()) {
    if (port.receive()) return true;
    wait(port, WaitFor::frame, no_deadline);
  }
  return false;
}

pid_t in_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  return child;
}

struct Times {
  std::vector<std::int64_t> ns;

  void measure(const std::function<void()>& round) {
    for (int n = 0; n < block; ++n) {
      const std::int64_t start = clock_ns(CLOCK_MONOTONIC);
      round();
      ns.push_back(clock_ns(CLOCK_MONOTONIC) - start);
    }
  }
  [[nodiscard]] double us(double quantile) const {  // requires sorted times
    return static_cast<double>(ns[static_cast<std::size_t>(quantile * static_cast<double>(ns.size() - 1))]) *
           1e-3;
  }
};

void print(const char* name, const Times& times) {
  fmt::print("{:<22}{:>9.2f}{:>9.2f}{:>10.2f}  us\n", name, times.us(0.5), times.us(0.99), times.us(1));
}

int compare(int rounds, double limit) {
  const std::string bus = fmt::format("local:round-trip-{}", ::getpid());
  auto hub = host_local_bus(bus, {});
  std::array<int, 2> ends{};
  if (!hub || ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return 2;
  Port& host = **hub;

  const pid_t bare_child = in_child([&] {
    ::close(ends[0]);
    while (bare_receive(ends[1])) bare_send(ends[1]);
  });
  const pid_t bus_child = in_child([&] {
    auto node = open_port(bus, {});
    if (!node) ::_exit(1);
    (*node)->send(ping());
    while (bus_receive(**node)) (*node)->send(ping());
  });
  ::close(ends[1]);
  bus_receive(host);  // waits until the node has connected and sent its first frame

  Times bare;
  Times local;
  for (int n = 0; n < rounds + block; n += block) {
    bare.measure([&] { bare_send(ends[0]), bare_receive(ends[0]); });
    local.measure([&] { host.send(ping()), bus_receive(host); });
    if (n == 0) bare.ns.clear(), local.ns.clear();  // the first block is only a warm-up
  }
  for (const pid_t child : {bare_child, bus_child}) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }

  std::ranges::sort(bare.ns);
  std::ranges::sort(local.ns);
  fmt::print("{} round trips each    p50      p99       max\n", local.ns.size());
  print("bare socketpair", bare);
  print("local bus, host-node", local);
  const double ratio = local.us(0.5) / bare.us(0.5);
  fmt::print("ratio of p50 {:.3f}, of p99 {:.3f}\n", ratio, local.us(0.99) / bare.us(0.99));
  return limit > 0 && ratio > limit ? 1 : 0;
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) {
  return canhil::compare(argc > 1 ? std::atoi(argv[1]) : 100'000, argc > 2 ? std::atof(argv[2]) : 0);
}
