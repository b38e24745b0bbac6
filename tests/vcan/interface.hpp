// Helper functions for the tests on vcan: ports, frames and interfaces.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {

inline std::unique_ptr<Port> open(const std::string& interface, const PortOptions& options = {}) {
  auto port = open_port(interface, options);
  EXPECT_TRUE(port) << port.error().message;
  return port ? std::move(*port) : nullptr;
}

inline std::string why_not(const std::string& interface, const PortOptions& options = {}) {
  const auto port = open_port(interface, options);
  return port ? "opened" : port.error().message;
}

inline void run(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0) << command; }

/// Sends the frame. While the transmit queue is full, waits and tries again.
inline SendOutcome send_all(Port& port, const Frame& frame) {
  SendOutcome outcome = port.send(frame);
  while (outcome == SendOutcome::queue_full && wait(port, WaitFor::room, in_seconds(5)))
    outcome = port.send(frame);
  return outcome;
}

/// A virtual interface for one test. It is created by the constructor and removed by the destructor.
class Interface {
 public:
  Interface(std::string name, int mtu) : name_(std::move(name)), mtu_(mtu) { make(); }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  ~Interface() { (void)std::system(fmt::format("ip link del {} 2>/dev/null", name_).c_str()); }

  void make() const {
    run(fmt::format("ip link add dev {0} type vcan && ip link set {0} mtu {1} && ip link set {0} up", name_,
                    mtu_));
  }
  void remove() const { run("ip link del " + name_); }

 private:
  std::string name_;
  int mtu_;
};

}  // namespace canhil
