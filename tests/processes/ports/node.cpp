// A program that is a node or the host of an embedded bus, for local_bus_processes_test.
//   node ROLE BUS SENDER COUNT
// On success, the exit code is 0. On failure, the program prints what failed, and the exit code is 1.
#include <fmt/format.h>
#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <functional>
#include <map>

#include "dbc/ports/local_bus.hpp"
#include "tests/processes/ports/stream.hpp"

namespace canhil {
namespace {

struct Task {
  std::string bus;
  std::uint64_t sender;
  std::uint64_t count;
};

[[noreturn]] void give_up(const std::string& why) {
  fmt::print("{}\n", why);
  std::exit(1);
}

std::unique_ptr<Port> join(const Task& task, bool own_echo) {
  auto port =
      open_port(task.bus, {.fd = true, .own_echo = own_echo, .node_name = fmt::format("{}", task.sender)});
  if (!port) give_up(port.error().message);
  return std::move(*port);
}

void wait_for(Port& port, WaitFor what) {
  if (port.closed()) give_up("the bus closed");
  wait(port, what, no_deadline);
}

/// Waits for the first frame of sender 0. Then sends the stream of this node, and at the same time receives
/// the stream of sender 0.
void exchange(const Task& task) {
  const auto port = join(task, false);
  wait_for(*port, WaitFor::frame);
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  while (sent < task.count || received < task.count) {
    while (sent < task.count && port->send(streamed(task.sender, sent)) == SendOutcome::sent) ++sent;
    while (const auto got = port->receive()) {
      if (!(got->frame == streamed(0, received))) give_up(fmt::format("frame {} differs", received));
      ++received;
    }
    if (received < task.count) {
      wait_for(*port, WaitFor::frame);
    } else if (sent < task.count) {
      wait_for(*port, WaitFor::room);
    }
  }
}

/// Sends its stream without ever reading from the bus.
void babble(const Task& task) {
  const auto port = join(task, false);
  for (std::uint64_t sent = 0; sent < task.count;) {
    if (port->send(streamed(task.sender, sent)) == SendOutcome::sent) {
      ++sent;
    } else {
      wait_for(*port, WaitFor::room);
    }
  }
}

/// Sends its stream, receives the streams of three nodes, including its own, and prints a digest of the
/// frames and their order.
void witness(const Task& task) {
  const auto port = join(task, true);
  while (!port->receive()) wait_for(*port, WaitFor::frame);  // the start signal
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  Order order;
  while (sent < task.count || received < 3 * task.count) {
    if (sent < task.count && port->send(streamed(task.sender, sent)) == SendOutcome::sent) ++sent;
    while (const auto got = port->receive()) {
      order.add(*got);
      ++received;
    }
    if (received < 3 * task.count && sent == task.count) wait_for(*port, WaitFor::frame);
  }
  fmt::print("{:016x}\n", order.sum());
}

/// Receives the stream of sender 0, far more slowly than sender 0 sends it.
void dawdle(const Task& task) {
  const auto port = join(task, false);
  for (std::uint64_t n = 0; n < task.count; ++n) {
    if (n % 100 == 0) ::usleep(1000);
    auto got = port->receive();
    for (; !got; got = port->receive()) wait_for(*port, WaitFor::frame);
    if (!(got->frame == streamed(0, n))) give_up(fmt::format("frame {} differs", n));
  }
}

/// Joins the bus and never reads from it.
void ignore(const Task& task) {
  const auto port = join(task, false);
  while (!port->closed()) ::pause();
}

/// Hosts the bus until this process is killed. A node that has received a frame of the host is connected to
/// the bus.
void host(const Task& task) {
  auto hub = host_local_bus(task.bus, {.fd = true});
  if (!hub) give_up(hub.error().message);
  run_hub(**hub, [&] {
    if (!(*hub)->nodes().empty()) (*hub)->send(streamed(0, 0));
    return false;
  });
}

}  // namespace
}  // namespace canhil

int main(int argc, char** argv) {
  using namespace canhil;
  const std::map<std::string, std::function<void(const Task&)>> roles{
      {"exchange", exchange}, {"babble", babble}, {"witness", witness},
      {"dawdle", dawdle},     {"ignore", ignore}, {"host", host}};
  if (argc != 5 || !roles.contains(argv[1])) give_up("expected ROLE BUS SENDER COUNT");
  roles.at(argv[1])({argv[2], std::strtoull(argv[3], nullptr, 10), std::strtoull(argv[4], nullptr, 10)});
  return 0;
}
