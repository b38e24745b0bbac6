// Tests a full transmit queue of 10 frames. While the queue is full, the kernel returns ENOBUFS; poll()
// cannot wait for the end of this state.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <map>
#include <thread>

#include "messages/canhil.hpp"
#include "tests/controller/guest.hpp"
#include "tests/vcan/interface.hpp"

namespace canhil::test {
namespace {

// Several ports are needed to fill the queue, because the send buffer of one port is smaller than the queue.
TEST(TransmitQueue, FullOfManySendersSaysSoAndLosesNothing) {
  set_up_on_wire();
  run("ip link set can1 txqueuelen 10");
  const auto listener = open("can0");
  constexpr int senders = 4;
  std::vector<std::unique_ptr<Port>> ports;
  for (int i = 0; i < senders; ++i) ports.push_back(open("can1"));
  std::map<std::uint32_t, std::vector<int>> sent, received;
  const auto frame = [&](int sender) {
    Frame one;
    one.id = static_cast<std::uint32_t>(0x700 + sender);
    one.size = 1;
    one.data[0] = static_cast<std::uint8_t>(sent[one.id].size());
    return one;
  };

  wire("can1 held");
  bool no_buffers = false;
  for (int sender = 0; sender < senders; ++sender) {
    Port& port = *ports[static_cast<std::size_t>(sender)];
    for (;;) {
      const Frame next = frame(sender);
      const SendOutcome outcome = port.send(next);
      if (outcome != SendOutcome::sent) {
        EXPECT_EQ(outcome, SendOutcome::queue_full);
        no_buffers = no_buffers || (port.room_wait().events == 0 && port.room_wait().pause_ns > 0);
        break;
      }
      sent[next.id].push_back(next.data[0]);
      ASSERT_LT(sent[next.id].size(), 50U) << "the wire is not held";
    }
  }
  EXPECT_TRUE(no_buffers) << "the interface's queue was never full";
  std::size_t waiting = 0;
  for (const auto& [id, numbers] : sent) waiting += numbers.size();
  EXPECT_GE(waiting, 11U) << "10 in the queue, one in the controller";
  EXPECT_LE(waiting, 12U) << "and one between them";

  wire("can1 slow 130");  // 130 us per frame, as at 1 Mbit/s
  for (int sender = 0; sender < senders; ++sender) {
    for (int i = 0; i < 20; ++i) {
      const Frame next = frame(sender);
      ASSERT_EQ(send_all(*ports[static_cast<std::size_t>(sender)], next), SendOutcome::sent);
      sent[next.id].push_back(next.data[0]);
    }
  }
  while (wait(*listener, WaitFor::frame, in_seconds(1))) {
    while (const auto one = listener->receive()) received[one->frame.id].push_back(one->frame.data[0]);
  }
  EXPECT_EQ(sent, received) << "each sender's frames, all of them, in its order";
}

// The traffic of another program fills the queue during a run: the bench waits for room, loses no frame, and
// reports how late it was.
TEST(TransmitQueue, FullDuringARunLosesNothingAndIsCounted) {
  set_up_on_wire();
  run("ip link set can1 txqueuelen 10");
  const Target target;
  const std::string json = scratch("queue.json");
  Ended ended;
  std::thread bench(
      [&] { ended = bench_run(fmt::format("{} --json {}", scenario("transfer_alignment_quick"), json)); });
  std::vector<std::unique_ptr<Port>> others;
  for (int i = 0; i < 4; ++i) others.push_back(open("can1"));
  await_syncs(50);
  wire("can1 held");
  for (const auto& other : others) {
    while (other->send(frame_of(0x7FF)) == SendOutcome::sent) {
    }
  }
  ::usleep(50'000);
  wire("can1 sound");
  bench.join();
  const auto report = read_json(json);
  EXPECT_TRUE(report["ending"]["completed"]) << ended.out;
  EXPECT_EQ(report["target_counters"]["frames_lost"], 0);
  EXPECT_GE(report["bus"]["late_in_queue"], 1);
  EXPECT_EQ(target.said(), "");
}

}  // namespace
}  // namespace canhil::test
