#include "target/process/bus_notes.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>

#include <ctime>

namespace canhil::target {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A port in a state that the test sets.
class StatePort final : public Port {
 public:
  SendOutcome send(const Frame&) override { return SendOutcome::down; }
  std::optional<Received> receive() override { return std::nullopt; }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return count; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return label; }

  PortCounters count;
  std::string label = "can7";
};

Frame error_frame(std::uint32_t classes) { return {.id = classes, .size = CAN_ERR_DLC, .error = true}; }

class Notes : public testing::Test {
 protected:
  std::string news() { return notes_.news(port_, BusFormat::classic); }
  BusNotes notes_;
  StatePort port_;
};

TEST_F(Notes, AreNoneOfAQuietBus) { EXPECT_EQ(news(), ""); }

TEST_F(Notes, TellAChangeOfStateAtOnceAndOnce) {
  notes_.error_frame(error_frame(CAN_ERR_ACK));
  EXPECT_EQ(news(), "can7: 1 error frames (no acknowledgement 1)\n");
  notes_.error_frame(error_frame(CAN_ERR_BUSOFF));
  EXPECT_EQ(news(), "can7: 2 error frames (bus off 1, no acknowledgement 1)\n");
  EXPECT_EQ(news(), "");
  notes_.error_frame(error_frame(CAN_ERR_RESTARTED));
  EXPECT_THAT(news(), HasSubstr("restarted 1"));
}

TEST_F(Notes, DoNotFlood) {
  notes_.error_frame(error_frame(CAN_ERR_ACK));
  EXPECT_NE(news(), "");
  const std::int64_t start_ns = clock_ns(CLOCK_MONOTONIC);
  notes_.error_frame(error_frame(CAN_ERR_ACK));
  const std::string soon = news();
  const bool a_second_passed = clock_ns(CLOCK_MONOTONIC) - start_ns >= 900'000'000;
  EXPECT_TRUE(soon.empty() || a_second_passed) << soon;
}

TEST_F(Notes, TellAnOutageAndItsEnd) {
  notes_.interface_is(false);
  EXPECT_EQ(news(), "can7: the interface is down or removed; waiting for it\n");
  EXPECT_EQ(news(), "");
  notes_.met_interface_down();
  notes_.met_interface_down();
  notes_.interface_is(true);
  EXPECT_THAT(news(), AllOf(StartsWith("can7: up again after "), HasSubstr("2 frames were not sent")));
  EXPECT_EQ(news(), "");
}

TEST_F(Notes, TellAnOutageThatIsOverAlready) {
  notes_.interface_is(false);
  notes_.interface_is(true);
  EXPECT_THAT(news(), StartsWith("can7: up again after "));
  EXPECT_EQ(news(), "");
}

TEST_F(Notes, TellWhatWasLostAndWhere) {
  notes_.late_in_queue();
  EXPECT_EQ(news(), "can7: late in transmit queue: 1 frames since the start, not sent\n");
  port_.count.overflowed = 3;
  EXPECT_EQ(news(), "can7: the receive queue overflowed: 3 frames lost since the start\n");
  EXPECT_EQ(news(), "");
}

}  // namespace
}  // namespace canhil::target
