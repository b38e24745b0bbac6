// Tests a bus with two targets, each of which was started as if it were the only target.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>
#include <thread>

#include "dbc/ports/local_bus.hpp"
#include "messages/canhil.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

class TwoTargets : public testing::Test {
 protected:
  void SetUp() override {
    auto hub = host_local_bus(bus_, {});
    ASSERT_TRUE(hub) << hub.error().message;
    hub_ = std::move(*hub);
    server_ = std::thread([this] { run_hub(*hub_, [this] { return stop_.load(); }); });
  }
  void TearDown() override {
    for (const pid_t target : targets_) {
      ::kill(target, SIGKILL);
      ::waitpid(target, nullptr, 0);
    }
    stop_ = true;
    if (server_.joinable()) server_.join();
  }
  /// Starts a target and waits for its first heartbeat. No other target may send heartbeats meanwhile.
  pid_t start_target() {
    const auto ear = open_port(bus_, {.only_ids = {messages::TargetHeartbeat::info.id}}).value();
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::execl(HIL_TARGET, HIL_TARGET, "--bus", bus_.c_str(), nullptr);
      ::_exit(127);
    }
    targets_.push_back(pid);
    EXPECT_TRUE(wait(*ear, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 20 * ns_per_s)) << "no heartbeat";
    return pid;
  }

  const std::string bus_ = fmt::format("local:two-targets-{}", ::getpid());
  std::unique_ptr<LocalHub> hub_;
  std::atomic<bool> stop_ = false;
  std::thread server_;
  std::vector<pid_t> targets_;
};

// Before its first frame, a target listens for another target on the bus. Here the second target detects
// none, because the first target is suspended while the second one listens.
TEST_F(TwoTargets, EndTheRun) {
  const pid_t first = start_target();
  ::kill(first, SIGSTOP);
  int status = 0;
  ASSERT_EQ(::waitpid(first, &status, WUNTRACED), first);
  ASSERT_TRUE(WIFSTOPPED(status));
  ::usleep(50'000);  // until the hub has forwarded all frames of the target
  start_target();
  ::kill(first, SIGCONT);
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --target none", scenario("transfer_alignment_quick"), bus_));
  // The exit code depends on when the bench detects the second target.
  EXPECT_TRUE(ended.code == 1 || ended.code == 2) << ended.code;
  EXPECT_THAT(ended.out + ended.err, testing::HasSubstr("a second target answers on this bus"));
}

}  // namespace
}  // namespace canhil::test
