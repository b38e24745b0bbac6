// Faults of a SocketCAN interface, on vcan0 and vcan1 of a real kernel (tests/vcan/run.sh provides them).
#include <gmock/gmock.h>
#include <linux/can/error.h>
#include <poll.h>

#include <ctime>

#include "dbc/ports/bus_errors.hpp"
#include "dbc/ports/socketcan.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil {
namespace {

using ::testing::EndsWith;

/// Receives in a loop, as every user of a port does, until the interface is up (if `up` is true) or down (if
/// `up` is false).
void wait_until(Port& port, bool up) {
  const std::int64_t deadline = in_seconds(5);
  while (port.up() != up && clock_ns(CLOCK_MONOTONIC) < deadline) {
    wait(port, WaitFor::frame, deadline);
    while (port.receive()) {
    }
  }
  ASSERT_EQ(port.up(), up);
}

/// Sends and waits in a loop for a tenth of a second. Returns the number of iterations.
int rounds(Port& port, WaitFor what) {
  const std::int64_t deadline = clock_ns(CLOCK_MONOTONIC) + 100'000'000;
  int count = 0;
  for (; clock_ns(CLOCK_MONOTONIC) < deadline; ++count) {
    EXPECT_NE(port.send(frame_of(1)), SendOutcome::sent);
    wait(port, what, deadline);
  }
  return count;
}

TEST(SocketCan, CountsWhatTheReceiveQueueLost) {
  const auto a = open("vcan0");
  const auto b = open("vcan0", {.receive_buffer_bytes = 1});
  constexpr unsigned burst = 1000;
  for (unsigned n = 0; n < burst; ++n) ASSERT_EQ(send_all(*a, numbered(1, n)), SendOutcome::sent);
  while (b->receive()) {
  }
  EXPECT_LT(b->counters().received, burst);
  a->send(frame_of(2));  // the kernel reports the loss with the next frame that it queues
  ASSERT_TRUE(next_frame(*b));
  EXPECT_EQ(b->counters().received + b->counters().overflowed, burst + 1);
}

TEST(SocketCan, CountsALossAfterWhichNothingCame) {
  const auto a = open("vcan0");
  const auto b = open("vcan0", {.receive_buffer_bytes = 1});
  constexpr unsigned burst = 1000;
  for (unsigned n = 0; n < burst; ++n) ASSERT_EQ(send_all(*a, numbered(1, n)), SendOutcome::sent);
  while (b->receive()) {
  }
  EXPECT_GT(b->counters().overflowed, 0U);
  EXPECT_EQ(b->counters().received + b->counters().overflowed, burst);
}

TEST(SocketCan, ReceivesABurstOfAThousandFramesThatNobodyReads) {
  const auto a = open("vcan0");
  const auto b = open("vcan0");
  for (unsigned n = 0; n < 1000; ++n) ASSERT_EQ(send_all(*a, numbered(1, n)), SendOutcome::sent);
  for (unsigned n = 0; n < 1000; ++n) ASSERT_EQ(number_of(next_frame(*b)->frame), n);
  EXPECT_EQ(b->counters().overflowed, 0U);
}

TEST(SocketCan, ReceivesErrorFramesAndNoRemoteFrames) {
  const auto port = open("vcan0", {.only_ids = {0x100}});
  run("cansend vcan0 100#R; cansend vcan0 20000040#0000000000000000; cansend vcan0 "
      "20000004#0030000000000000");
  const auto bus_off = next_frame(*port);
  ASSERT_TRUE(bus_off);
  EXPECT_TRUE(bus_off->frame.error);
  EXPECT_EQ(bus_off->frame.id, static_cast<std::uint32_t>(CAN_ERR_BUSOFF));
  const auto passive = next_frame(*port);
  ASSERT_TRUE(passive);
  EXPECT_EQ(passive->frame.id, static_cast<std::uint32_t>(CAN_ERR_CRTL));
  EXPECT_EQ(passive->frame.data[1], CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(port->counters().error_frames, 2U);
}

TEST(SocketCan, GoesOnWhenTheInterfaceIsUpAgain) {
  const auto a = open("vcan0");
  const auto b = open("vcan0");
  run("ip link set vcan0 down");
  EXPECT_EQ(a->send(frame_of(1)), SendOutcome::down);
  EXPECT_FALSE(a->up());
  EXPECT_TRUE(wait(*b, WaitFor::frame, 0)) << "a waiting receiver is woken";
  EXPECT_FALSE(b->receive());
  EXPECT_FALSE(b->up());
  EXPECT_FALSE(b->closed());
  EXPECT_THAT(why_not("vcan0"), EndsWith("is down: `ip link set vcan0 up`"));
  EXPECT_LT(rounds(*a, WaitFor::room), 50) << "waiting does not wait";
  EXPECT_LT(rounds(*a, WaitFor::frame), 50) << "waiting does not wait";
  run("ip link set vcan0 up");
  wait_until(*a, true);
  wait_until(*b, true);
  EXPECT_EQ(a->send(frame_of(2)), SendOutcome::sent);
  EXPECT_EQ(next_frame(*b)->frame.id, 2U);
}

TEST(SocketCan, AWaitWithoutDeadlineSeesTheReturn) {
  const auto port = open("vcan0");
  run("ip link set vcan0 down");
  EXPECT_FALSE(port->receive());
  run("ip link set vcan0 up");
  while (!port->up()) {
    ASSERT_TRUE(wait(*port, WaitFor::frame, no_deadline));
    port->receive();
  }
}

/// An interface that was removed and created again has a new index. Sockets that are bound to the old index
/// receive nothing, so the port must bind again.
TEST(SocketCan, BindsToAnInterfaceThatWasMadeAnew) {
  const Interface interface("canhil7", 72);
  const auto a = open("canhil7", {.fd = true, .own_echo = true});
  const auto b = open("canhil7", {.only_ids = {0x100}});
  interface.remove();
  wait_until(*b, false);
  EXPECT_EQ(a->send(frame_of(0x100)), SendOutcome::down);
  EXPECT_FALSE(a->up());
  EXPECT_FALSE(a->closed());
  EXPECT_LT(rounds(*a, WaitFor::room), 50) << "waiting does not wait";
  for (int times = 0; times < 3; ++times) {
    interface.make();
    wait_until(*a, true);
    wait_until(*b, true);
    ASSERT_EQ(a->send(frame_of(0x101)), SendOutcome::sent);
    ASSERT_EQ(a->send(numbered(0x100, 7)), SendOutcome::sent);
    run("cansend canhil7 20000040#0000000000000000");
    EXPECT_EQ(next_frame(*b)->frame, numbered(0x100, 7)) << "the filter holds again";
    EXPECT_TRUE(next_frame(*b)->frame.error) << "error frames pass again";
    EXPECT_TRUE(next_frame(*a)->own);
    interface.remove();
    wait_until(*a, false);
    wait_until(*b, false);
  }
}

TEST(SocketCan, BindsToAnInterfaceThatWasMadeAnewWithItsOldIndex) {
  const std::string make = "ip link add dev canhil7 index 77 type vcan && ip link set canhil7 up";
  run(make);
  const auto a = open("canhil7");
  const auto b = open("canhil7");
  run("ip link del canhil7");
  wait_until(*b, false);
  EXPECT_EQ(a->send(frame_of(1)), SendOutcome::down);
  run(make);
  wait_until(*a, true);
  wait_until(*b, true);
  EXPECT_EQ(a->send(frame_of(1)), SendOutcome::sent);
  EXPECT_TRUE(next_frame(*b));
  run("ip link del canhil7");
}

TEST(SocketCan, ASenderAloneFindsTheInterfaceThatWasMadeAnew) {
  const Interface interface("canhil7", 16);
  const auto port = open("canhil7");
  interface.remove();
  EXPECT_EQ(port->send(frame_of(1)), SendOutcome::down);
  interface.make();
  SendOutcome outcome = SendOutcome::down;
  for (const std::int64_t deadline = in_seconds(5);
       outcome != SendOutcome::sent && clock_ns(CLOCK_MONOTONIC) < deadline;) {
    wait(*port, WaitFor::room, deadline);
    outcome = port->send(frame_of(1));
  }
  EXPECT_EQ(outcome, SendOutcome::sent);
}

TEST(SocketCan, AnFdPortDoesNotGoOnWithAClassicInterface) {
  const Interface interface("canhil7", 72);
  const auto port = open("canhil7", {.fd = true});
  run("ip link set canhil7 down && ip link set canhil7 mtu 16 && ip link set canhil7 up");
  EXPECT_FALSE(port->receive());
  for (int n = 0; n < 5; ++n) {
    EXPECT_TRUE(wait(*port, WaitFor::frame, no_deadline));
    EXPECT_FALSE(port->receive());
  }
  EXPECT_FALSE(port->up());
}

/// Slows vcan1 down with the traffic control of the kernel: frames wait in a queue of some bytes and are sent
/// at 100 kbit/s.
class SlowWire : public ::testing::Test {
 protected:
  static void slow_down(int queue_bytes, const std::string& rate = "100kbit") {
    run(fmt::format("tc qdisc replace dev vcan1 root tbf rate {} burst 100 limit {}", rate, queue_bytes));
  }
  void TearDown() override { (void)std::system("tc qdisc del dev vcan1 root"); }

  static void send_and_receive(int frames) {
    const auto a = open("vcan1");
    const auto b =
        open("vcan1", {.only_ids = {2}});  // leaves out frames with id 1, which filled the queue before
    int full = 0;
    for (int n = 0; n < frames; ++n) {
      const Frame frame = numbered(2, static_cast<std::uint32_t>(n));
      for (SendOutcome outcome = a->send(frame); outcome != SendOutcome::sent; outcome = a->send(frame)) {
        ASSERT_EQ(outcome, SendOutcome::queue_full);
        ASSERT_LT(++full, 20 * frames) << "waiting does not wait";
        ASSERT_TRUE(wait(*a, WaitFor::room, in_seconds(5)));
      }
    }
    EXPECT_GT(full, 0);
    for (int n = 0; n < frames; ++n)
      ASSERT_EQ(number_of(next_frame(*b)->frame), static_cast<std::uint32_t>(n));
  }
};

TEST_F(SlowWire, FillsTheSocketFirst) {
  slow_down(100'000, "1kbit");  // only 8 frames per second, so none leaves the queue while the test fills it
  const auto port = open("vcan1");
  while (port->send(frame_of(1)) == SendOutcome::sent)
    ASSERT_LT(port->counters().sent, 1000U) << "no slow wire";
  EXPECT_EQ(port->room_wait().events, POLLOUT);
  // The `burst` of 100 bytes lets the first 6 frames, of 16 bytes each, pass at once.
  EXPECT_LE(port->counters().sent, 6U + 10U) << "more than an interface's queue holds";
  slow_down(100'000);
  send_and_receive(100);
}

TEST_F(SlowWire, PausesWhenTheInterfacesQueueIsFull) {
  slow_down(40);
  const auto port = open("vcan1");
  while (port->send(frame_of(1)) == SendOutcome::sent)
    ASSERT_LT(port->counters().sent, 1000U) << "no slow wire";
  EXPECT_GT(port->room_wait().pause_ns, 0) << "ENOBUFS: poll() would say writable at once";
  send_and_receive(100);
}

}  // namespace
}  // namespace canhil
