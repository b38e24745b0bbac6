#include "dbc/ports/port.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include "dbc/ports/descriptor.hpp"
#include "dbc/wire/frame_rules.hpp"
#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {
namespace {

using ::testing::StartsWith;

std::string why_not(const std::string& bus) {
  const auto port = open_port(bus, {});
  return port ? "opened" : port.error().message;
}

TEST(OpenPort, ExplainsWhichBusesThereAre) {
  for (const char* bus : {"", "can0:1", "udp:x", "../x", "a b"}) {
    EXPECT_EQ(why_not(bus), "bus '" + std::string(bus) +
                                "': expected a CAN interface such as can0, local:NAME or log:FILE");
  }
}

TEST(OpenPort, ExplainsThatTheBusInsideTheBenchIsNotShared) {
  EXPECT_EQ(why_not("in-process"),
            "bus 'in-process': is not a bus between two programs, expected a CAN interface such as can0, "
            "local:NAME or log:FILE");
}

TEST(OpenPort, ExplainsWhatIsMissingOfCan) {  // tests/vcan tests this with AF_CAN and interfaces
  const Descriptor can(::socket(AF_CAN, SOCK_RAW, 1));
  const std::string why = why_not("nocan7");
  if (can) {
    EXPECT_THAT(why, StartsWith("no CAN interface 'nocan7' on this machine; it has"));
  } else {
    EXPECT_THAT(why, StartsWith("cannot open 'nocan7': this kernel has no "));
  }
  EXPECT_EQ(why.find('\n'), std::string::npos);
}

TEST(FrameRules, AreThoseOfTheStandard) {
  for (int size = 0; size <= 64; ++size) {
    const auto bytes = static_cast<std::uint8_t>(size);
    EXPECT_EQ(size_has_dlc(bytes, false), size <= 8) << size;
    EXPECT_EQ(size_has_dlc(bytes, true), size <= 8 || size == 12 || size == 16 || size == 20 || size == 24 ||
                                             size == 32 || size == 48 || size == 64)
        << size;
  }
  Frame frame = frame_of(0x7FF);
  EXPECT_TRUE(can_carry(frame, false));
  frame.brs = true;
  EXPECT_FALSE(can_carry(frame, true)) << "a bit rate switch without FD";
  frame.fd = true;
  EXPECT_TRUE(can_carry(frame, true));
  EXPECT_FALSE(can_carry(frame, false));
  frame.error = true;
  EXPECT_FALSE(can_carry(frame, true)) << "an FD error frame";
  frame = frame_of(0x800);
  EXPECT_FALSE(can_carry(frame, true));
  frame.extended = true;
  EXPECT_TRUE(can_carry(frame, false));
  frame.id = 0x2000'0000;
  EXPECT_FALSE(can_carry(frame, true));
}

/// A port that only waits.
class WaitingPort final : public Port {
 public:
  SendOutcome send(const Frame&) override { return SendOutcome::queue_full; }
  std::optional<Received> receive() override { return std::nullopt; }
  [[nodiscard]] int descriptor() const override { return event.get(); }
  [[nodiscard]] RoomWait room_wait() const override { return room; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] bool up() const override { return is_up; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return label; }

  Descriptor event{::eventfd(0, EFD_NONBLOCK)};
  RoomWait room;
  bool is_up = true;
  std::string label = "waiting";
};

TEST(Wait, EndsAtItsDeadlineNotBefore) {
  WaitingPort port;
  const std::int64_t deadline = clock_ns(CLOCK_MONOTONIC) + 3'000'000;
  EXPECT_FALSE(wait(port, WaitFor::frame, deadline));
  EXPECT_GE(clock_ns(CLOCK_MONOTONIC), deadline);
  EXPECT_FALSE(wait(port, WaitFor::frame, 0)) << "a deadline in the past";
}

TEST(Wait, EndsWithTheDescriptor) {
  WaitingPort port;
  ::eventfd_write(port.event.get(), 1);
  EXPECT_TRUE(wait(port, WaitFor::frame, no_deadline));
}

TEST(Wait, ForRoomDoesAsThePortSays) {
  WaitingPort port;
  EXPECT_TRUE(wait(port, WaitFor::room, 0)) << "nothing to wait for";
  port.room = {.events = 1};  // POLLIN
  EXPECT_FALSE(wait(port, WaitFor::room, 0));
  port.room = {.pause_ns = 2'000'000};
  const std::int64_t start = clock_ns(CLOCK_MONOTONIC);
  EXPECT_TRUE(wait(port, WaitFor::room, no_deadline));
  EXPECT_GE(clock_ns(CLOCK_MONOTONIC), start + 2'000'000);
  EXPECT_FALSE(wait(port, WaitFor::room, clock_ns(CLOCK_MONOTONIC) + 1'000'000)) << "the deadline came first";
}

TEST(Wait, LooksAgainWhereAnInterfaceIsAway) {
  WaitingPort port;
  port.is_up = false;
  port.room = {.events = POLLOUT};  // poll() can report this while the interface is down
  for (const WaitFor what : {WaitFor::frame, WaitFor::room}) {
    const std::int64_t start = clock_ns(CLOCK_MONOTONIC);
    EXPECT_TRUE(wait(port, what, no_deadline)) << "worth another try";
    EXPECT_GE(clock_ns(CLOCK_MONOTONIC), start + 10'000'000) << "but not at once";
    EXPECT_FALSE(wait(port, what, clock_ns(CLOCK_MONOTONIC) + 1'000'000)) << "the deadline came first";
  }
}

}  // namespace
}  // namespace canhil
