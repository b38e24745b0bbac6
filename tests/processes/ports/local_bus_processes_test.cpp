// Tests the embedded bus with real processes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "dbc/ports/local_bus.hpp"
#include "tests/processes/ports/stream.hpp"

namespace canhil {
namespace {

/// A process that runs the program `node` (node.cpp). The destructor kills the process if it has not ended.
class Process {
 public:
  Process(const std::string& role, const std::string& bus, int sender, std::uint64_t count) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    const std::string sender_text = std::to_string(sender);
    const std::string count_text = std::to_string(count);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      ::execl(NODE_PROGRAM, NODE_PROGRAM, role.c_str(), bus.c_str(), sender_text.c_str(), count_text.c_str(),
              nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (pid_ > 0) kill();
    ::close(output_);
  }

  void signal(int number) const { ::kill(pid_, number); }
  void kill() {
    signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  /// Waits for the end of the process and returns its exit status.
  int status() {
    int status = -1;
    ::waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }
  [[nodiscard]] std::string output() const {
    std::string text;
    std::array<char, 256> part{};
    for (ssize_t n = 0; (n = ::read(output_, part.data(), part.size())) > 0;)
      text.append(part.data(), static_cast<std::size_t>(n));
    return text;
  }

 private:
  pid_t pid_ = 0;
  int output_ = -1;
};

class LocalBusProcesses : public ::testing::Test {
 protected:
  void SetUp() override {
    // The bus waits for slow nodes, because these tests must pass on a machine that may stall for minutes. If
    // a frame never arrives, CTest ends the test.
    auto hub = host_local_bus(bus_, {.fd = true}, {.reading_limit_ns = 600'000'000'000});
    ASSERT_TRUE(hub) << hub.error().message;
    hub_ = std::move(*hub);
  }
  void wait_for_nodes(std::size_t count) {
    while (hub_->nodes().size() != count) {
      wait(*hub_, WaitFor::frame, no_deadline);
      EXPECT_FALSE(hub_->receive());
    }
    ASSERT_EQ(hub_->nodes().size(), count);
  }

  const std::string bus_ = fmt::format("local:processes-{}-{}", ::getpid(),
                                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::unique_ptr<LocalHub> hub_;
};

TEST_F(LocalBusProcesses, CarryAHundredThousandFramesEachWay) {
  constexpr std::uint64_t count = 100'000;
  Process node("exchange", bus_, 1, count);
  wait_for_nodes(1);
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  while (sent < count || received < count) {
    bool idle = true;
    for (; sent < count && hub_->send(streamed(0, sent)) == SendOutcome::sent; ++sent) idle = false;
    for (auto got = hub_->receive(); got; got = hub_->receive(), ++received) {
      ASSERT_EQ(got->frame, streamed(1, received)) << received;
      idle = false;
    }
    // receive() may deliver the frame that stalled the bus. Then there is room, and no frame need come to say
    // it.
    constexpr std::int64_t look_again_ns = 1'000'000;
    if (idle)
      wait(*hub_, WaitFor::frame, sent < count ? clock_ns(CLOCK_MONOTONIC) + look_again_ns : no_deadline);
  }
  EXPECT_EQ(received, count);
  EXPECT_EQ(node.status(), 0) << node.output();
}

TEST_F(LocalBusProcesses, ThreeNodesAndTheHostSeeOneOrder) {
  constexpr std::uint64_t count = 10'000;
  std::array<Process, 3> nodes{Process("witness", bus_, 1, count), Process("witness", bus_, 2, count),
                               Process("witness", bus_, 3, count)};
  wait_for_nodes(3);
  ASSERT_EQ(hub_->send(streamed(0, 0)), SendOutcome::sent);
  Order order;
  std::array<std::uint64_t, 3> next{};
  int turns = 0;  // how often two consecutive frames had different senders
  std::size_t last = 0;
  for (std::uint64_t received = 0; received < 3 * count;) {
    const auto got = hub_->receive();
    if (!got) {
      wait(*hub_, WaitFor::frame, no_deadline);
      continue;
    }
    order.add(*got);
    ++received;
    std::size_t sender = 0;
    while (sender < 3 && !(got->frame == streamed(sender + 1, next[sender]))) ++sender;
    ASSERT_LT(sender, 3U) << "no sender's next frame";
    ++next[sender];
    if (sender != last) ++turns;
    last = sender;
  }
  hub_->receive();  // delivers frames that the hub may not have forwarded yet
  EXPECT_GT(turns, 10) << "the senders did not compete";
  const std::string expected = fmt::format("{:016x}\n", order.sum());
  for (Process& node : nodes) {
    EXPECT_EQ(node.output(), expected);
    EXPECT_EQ(node.status(), 0);
  }
}

/// Sends the frames of the stream of sender 0, beginning with number `from`, and waits whenever the bus has
/// no room. Returns how often it waited.
int send_stream(Port& port, std::uint64_t from, std::uint64_t count) {
  int full = 0;
  for (std::uint64_t sent = from; sent < count;) {
    if (port.send(streamed(0, sent)) == SendOutcome::sent) {
      ++sent;
    } else {
      ++full;
      wait(port, WaitFor::room, no_deadline);
    }
  }
  return full;
}

TEST_F(LocalBusProcesses, ASlowReaderHoldsTheSenderBackAndLosesNothing) {
  Process reader("dawdle", bus_, 1, 20'000);
  wait_for_nodes(1);
  EXPECT_GT(send_stream(*hub_, 0, 20'000), 0);
  while (!hub_->nodes().empty()) {  // the hub may not have forwarded the last frame yet
    wait(*hub_, WaitFor::frame, no_deadline);
    hub_->receive();
  }
  EXPECT_EQ(reader.status(), 0) << reader.output();
}

TEST_F(LocalBusProcesses, AStuckNodeStopsTheBusUntilItIsKilled) {
  constexpr std::uint64_t count = 20'000;
  Process reader("dawdle", bus_, 1, count);
  Process stuck("ignore", bus_, 2, 0);
  wait_for_nodes(2);
  std::uint64_t sent = 0;
  // This loop ends when the hub reports that node 2 (`stuck`) holds up the bus. The other node is slow too,
  // but continues to read.
  while (hub_->held_up_by() != "2") {
    wait(*hub_, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 1'000'000);
    if (hub_->send(streamed(0, sent)) == SendOutcome::sent) ++sent;
    ASSERT_LT(sent, count) << "no back-pressure";
  }
  EXPECT_EQ(hub_->send(streamed(0, sent)), SendOutcome::queue_full);
  stuck.kill();
  send_stream(*hub_, sent, count);
  while (!hub_->nodes().empty()) {
    wait(*hub_, WaitFor::frame, no_deadline);
    hub_->receive();
  }
  EXPECT_EQ(reader.status(), 0) << reader.output();
}

TEST_F(LocalBusProcesses, ANodeKilledWhileItSendsLeavesNoGap) {
  Process victim("babble", bus_, 1, 1'000'000'000);
  std::uint64_t received = 0;
  while (received == 0 || !hub_->nodes().empty()) {
    wait(*hub_, WaitFor::frame, no_deadline);
    while (const auto got = hub_->receive()) {
      ASSERT_EQ(got->frame, streamed(1, received));
      if (++received == 5000) victim.kill();
    }
  }
  EXPECT_GE(received, 5000U);
  EXPECT_TRUE(hub_->nodes().empty());
}

TEST(LocalBusHost, ItsDeathClosesItsNodesWithinAPoll) {
  const std::string bus = fmt::format("local:processes-{}-killed-host", ::getpid());
  Process host("host", bus, 0, 0);
  auto node = open_port(bus, {.fd = true});
  while (!node) node = open_port(bus, {.fd = true});
  ASSERT_TRUE(node) << node.error().message;
  Port& port = **node;
  while (!port.receive()) ASSERT_TRUE(wait(port, WaitFor::frame, no_deadline));
  host.kill();
  while (!port.closed()) {
    ASSERT_TRUE(wait(port, WaitFor::frame, 0)) << "nothing wakes the node";
    while (port.receive()) {
    }
  }
  EXPECT_EQ(port.send(streamed(0, 0)), SendOutcome::down);
  EXPECT_TRUE(host_local_bus(bus, {})) << "the name is free again";
}

}  // namespace
}  // namespace canhil
