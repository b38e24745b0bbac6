#include "target/process/event_loop.hpp"

#include <gtest/gtest.h>

#include <ctime>

#include "messages/canhil.hpp"

namespace canhil::target {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

/// Delivers a frame on each call, for at most 5 s. Ends the run when the target has sent two heartbeats.
class FloodedPort final : public Port {
 public:
  SendOutcome send(const Frame& frame) override {
    heartbeats += frame.id == messages::TargetHeartbeat::info.id ? 1 : 0;
    if (heartbeats == 2) stop = true;
    return SendOutcome::sent;
  }
  std::optional<Received> receive() override {
    endless = endless && clock_ns(CLOCK_MONOTONIC) < end_ns;
    stop = stop || !endless;
    if (!endless) return std::nullopt;
    return Received{.frame = {.id = 0, .size = 8}};
  }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return label; }

  std::atomic<bool> stop = false;
  int heartbeats = 0;
  bool endless = true;

 private:
  std::string label = "can7";
  std::int64_t end_ns = clock_ns(CLOCK_MONOTONIC) + 5 * ns_per_s;
};

TEST(Serving, AFloodKeepsNoHeartbeatBack) {
  FloodedPort port;
  const auto served = serve(port, BusFormat::classic, port.stop);
  EXPECT_TRUE(served) << served.error().message;
  EXPECT_EQ(port.heartbeats, 2);
  EXPECT_TRUE(port.endless) << "it waited for the end of the flood";
}

}  // namespace
}  // namespace canhil::target
