// One end of a measurement on a CAN interface, with the project's port or with a plain raw socket. The other
// end is a second process of this program, a program of can-utils, or python-can (vcan.py).
//   vcan_node ROLE port|raw INTERFACE COUNT
//   ping: for each line on stdin, makes COUNT round trips, one after the other, to a node that answers each
//   frame; prints the times of the round trips [ns] on one line.
//   echo: receives COUNT frames with the id 0x77, and answers each of them with a frame that has the id 0x78,
//   as canfdtest does.
//   send: sends COUNT numbered frames as fast as possible.
//   receive: receives COUNT frames; prints how many were lost or out of order.
// The program waits for frames without a time limit; vcan.py limits its time.
#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "dbc/ports/port.hpp"

namespace canhil {
namespace {

constexpr std::uint32_t ping_id = 0x77;
constexpr std::uint32_t echo_id = 0x78;
constexpr int receive_bytes = 64 << 20;  // a receive queue of this size loses no frame

[[noreturn]] void give_up(const std::string& why) {
  fmt::print(stderr, "vcan_node: {}\n", why);
  std::exit(1);
}

/// A way to send and to receive frames: the port or a raw socket.
class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;
  virtual void send(std::uint32_t id, std::uint64_t number) = 0;
  /// Waits for the next frame with this id and returns its number.
  virtual std::uint64_t receive(std::uint32_t id) = 0;
};

class PortLine final : public Line {
 public:
  explicit PortLine(const std::string& interface) {
    auto opened = open_port(interface, {.receive_buffer_bytes = receive_bytes});
    if (!opened) give_up(opened.error().message);
    port_ = std::move(*opened);
  }
  void send(std::uint32_t id, std::uint64_t number) override {
    Frame frame{.id = id, .size = 8};
    std::memcpy(frame.data.data(), &number, sizeof number);
    while (port_->send(frame) != SendOutcome::sent)
      if (!wait(*port_, WaitFor::room, no_deadline)) give_up("no room");
  }
  std::uint64_t receive(std::uint32_t id) override {
    for (;;) {
      while (const auto received = port_->receive()) {
        if (received->frame.id != id) continue;
        std::uint64_t number = 0;
        std::memcpy(&number, received->frame.data.data(), sizeof number);
        return number;
      }
      wait(*port_, WaitFor::frame, no_deadline);
    }
  }

 private:
  std::unique_ptr<Port> port_;
};

/// The least that a program must do: blocking read() and write(), without stamps and without checks.
class RawLine final : public Line {
 public:
  explicit RawLine(const std::string& interface) : socket_(::socket(AF_CAN, SOCK_RAW, CAN_RAW)) {
    sockaddr_can at{};
    at.can_family = AF_CAN;
    at.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &receive_bytes, sizeof receive_bytes);
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) give_up("cannot bind");
  }
  RawLine(const RawLine&) = delete;
  RawLine& operator=(const RawLine&) = delete;
  ~RawLine() override { ::close(socket_); }
  void send(std::uint32_t id, std::uint64_t number) override {
    can_frame frame{};
    frame.can_id = id;
    frame.len = 8;
    std::memcpy(frame.data, &number, sizeof number);
    if (::write(socket_, &frame, sizeof frame) < 0) give_up("write failed");
  }
  std::uint64_t receive(std::uint32_t id) override {
    can_frame frame{};
    do {
      if (::read(socket_, &frame, sizeof frame) < 0) give_up("read failed");
    } while (frame.can_id != id);
    std::uint64_t number = 0;
    std::memcpy(&number, frame.data, sizeof number);
    return number;
  }

 private:
  int socket_;
};

void play_ping(Line& line, std::uint64_t count) {
  std::vector<std::int64_t> times_ns(count);
  while (std::getchar() != EOF) {
    for (std::uint64_t n = 0; n < count; ++n) {
      const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
      line.send(ping_id, n);
      line.receive(echo_id);
      times_ns[n] = clock_ns(CLOCK_MONOTONIC) - start_ns;
    }
    fmt::print("{}\n", fmt::join(times_ns, " "));
    std::fflush(stdout);
  }
}

void play_echo(Line& line, std::uint64_t count) {
  for (std::uint64_t n = 0; n < count; ++n) line.send(echo_id, line.receive(ping_id));
}

void play_send(Line& line, std::uint64_t count) {
  for (std::uint64_t n = 0; n < count; ++n) line.send(ping_id, n);
}

void play_receive(Line& line, std::uint64_t count) {
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < count; ++n) wrong += line.receive(ping_id) == n ? 0 : 1;
  fmt::print("{}\n", wrong);
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) {
  using namespace canhil;
  const std::map<std::string, std::function<void(Line&, std::uint64_t)>> roles{
      {"ping", play_ping}, {"echo", play_echo}, {"send", play_send}, {"receive", play_receive}};
  if (argc != 5 || !roles.contains(argv[1])) give_up("expected ROLE port|raw INTERFACE COUNT");
  const std::string interface = argv[3];
  std::unique_ptr<Line> line;
  if (std::string_view(argv[2]) == "port")
    line = std::make_unique<PortLine>(interface);
  else
    line = std::make_unique<RawLine>(interface);
  roles.at(argv[1])(*line, std::strtoull(argv[4], nullptr, 10));
  return 0;
}
