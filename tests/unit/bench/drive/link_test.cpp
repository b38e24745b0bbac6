// A bus that delivers more frames than the bench can process.
#include "bench/drive/link.hpp"
#include "bench/protocol/contract_watch.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <atomic>

#include "bench/drive/real_time.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "tests/unit/bench/drive/fake_port.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

// Delivers `most` frames. Every tenth frame has the id 123; all other frames have the id 0C0.
class FloodedPort final : public FakePort {
 public:
  std::optional<Received> receive() override {
    if (brought == most) return std::nullopt;
    ++brought;
    if (on_receive) on_receive();
    return Received{.frame = {.id = brought % 10 == 0 ? 0x123U : 0x0C0U, .size = 8}};
  }
  [[nodiscard]] std::int64_t monotonic_ns() const override {
    return simulated ? static_cast<std::int64_t>(brought) * frame_ns : FakePort::monotonic_ns();
  }
  [[nodiscard]] int descriptor() const override { return ends[0]; }
  [[nodiscard]] PortCounters counters() const override { return {.overflowed = overflowed}; }
  std::array<int, 2> ends{-1, -1};
  std::uint64_t overflowed = 0;
  std::uint64_t brought = 0;
  std::uint64_t most = 50'000'000;
  bool simulated = false;
  std::int64_t frame_ns = 10'000;
  std::function<void()> on_receive;
};

class Counter final : public observe::Observer {
 public:
  void received(const Received& /*received*/) override { ++frames; }
  int frames = 0;
};

TEST(LinkDrain, LooksAtSoManyFramesAndNoMore) {
  FloodedPort port;
  port.most = 2 * Link::most_at_once + 1;
  Link link(port);
  Counter counter;
  const Attached attached(link, counter);
  for (const int expected : {Link::most_at_once, 2 * Link::most_at_once, 2 * Link::most_at_once + 1}) {
    EXPECT_EQ(link.drain(), LinkState::up);
    EXPECT_EQ(counter.frames, expected);
  }
}

TEST(LinkDrain, AWaitEndsAtOnceWhileFramesAreLeft) {
  FloodedPort port;
  port.most = Link::most_at_once + 1;
  ASSERT_EQ(::pipe(port.ends.data()),
            0);  // the pipe is never readable: poll() does not see the frames that the port holds
  Link link(port);
  link.drain();
  EXPECT_TRUE(link.wait_until(clock_ns(CLOCK_MONOTONIC)));
  link.drain();
  EXPECT_FALSE(link.wait_until(clock_ns(CLOCK_MONOTONIC)));
  for (const int end : port.ends) ::close(end);
}

TEST(LinkFlood, IsNamedByTheIdThatBringsMostFrames) {
  FloodedPort port;
  port.simulated = true;
  Link link(port);
  link.drain();
  while (port.monotonic_ns() < ns_per_s / 2) link.drain();
  ASSERT_TRUE(link.flood());
  EXPECT_THAT(
      to_text(*link.flood()),
      testing::MatchesRegex("the bus was flooded by id 0C0: [0-9]+ of [0-9]+ frames in 0\\.[0-9]+ s"));
}

TEST(SharesOfFrames, WhereNoIdHasHalfOfThemTheIdsAreCountedToo) {
  observe::Shares shares;
  for (std::uint32_t id = 0; id < 300; ++id) shares.add({.id = id % 3});
  EXPECT_EQ(shares.to_text(), "id 000: 100 of 300 frames, the most of 3 ids");
  for (int n = 0; n < 500; ++n) shares.add({.id = 0x12345, .extended = true});
  EXPECT_EQ(shares.to_text(), "id 00012345: 500 of 800 frames");
  for (int n = 0; n < 900; ++n) shares.add({.id = 4, .error = true});
  EXPECT_EQ(shares.to_text(), "error frames: 900 of 1700 frames");
}

TEST(SharesOfFrames, OfAllIdsOnlySoManyAreDistinguished) {
  observe::Shares shares;
  for (std::uint32_t id = 0; id < 100'000; ++id) shares.add({.id = id, .extended = true});
  EXPECT_EQ(shares.to_text(), "id 00000000: 1 of 100000 frames, the most of more than 4096 ids");
}

TEST(LinkFlood, FramesThatWaitedForABenchWithoutACpuAreNone) {
  FloodedPort port;
  port.simulated = true;
  port.most = 9'000;  // the link reads these frames within 90 ms
  Link link(port);
  while (port.brought < port.most) link.drain();
  port.most += 2'000'000;  // 20 s pass in which the link does not read
  while (port.brought < port.most) port.receive();
  port.most += 9'000;
  while (port.brought < port.most) link.drain();
  EXPECT_FALSE(link.flood());
}

// During a flood, the bench may get the CPU only for short periods.
TEST(LinkFlood, FramesThatWereLostMeanwhileHadBeenWaiting) {
  FloodedPort port;
  port.simulated = true;
  port.most = 0;
  Link link(port);
  for (int turn = 0; turn < 5; ++turn) {
    port.most += 1'000;
    while (port.brought < port.most) link.drain();
    port.most += 5'000;  // 50 ms pass in which the link does not read
    while (port.brought < port.most) port.receive();
    port.overflowed += 4'000;
  }
  ASSERT_TRUE(link.flood());
  EXPECT_GT(link.flood()->duration_ns, 200'000'000);
}

class Flooded : public testing::Test {
 protected:
  Ending run() { return run_until_silent(60 * ns_per_s); }
  Ending run_until_silent(std::int64_t silence_limit_ns) {
    Schedule schedule({}, std::make_unique<nodes::TimeKeeper>(50'000, false));
    protocol::ContractWatch watch;
    return run_real_time(link_, schedule, watch, silence_limit_ns, stop_, [](std::int64_t) {});
  }
  FloodedPort port_;
  Link link_{port_};
  std::atomic<bool> stop_ = false;
};

TEST_F(Flooded, TheBenchSendsAllTheSame) {
  std::uint64_t at_last_frame = 0;
  port_.on_send = [&](const Frame&) { at_last_frame = port_.brought; };
  EXPECT_EQ(run().kind, Ending::Kind::completed);
  EXPECT_EQ(port_.sent.size(), 6U);
  EXPECT_LT(at_last_frame, port_.most) << "it waited for the end of the flood";
}

TEST_F(Flooded, WhoFillsABusThatTakesNoFrameIsNamed) {
  port_.outcome = SendOutcome::queue_full;
  EXPECT_THAT(
      run_until_silent(ns_per_s / 10).detail,
      testing::MatchesRegex(
          "the bus has accepted no frame since t=0.000 s and carried id 0C0: [0-9]+ of [0-9]+ frames"));
}

TEST_F(Flooded, TheBenchHearsThatItIsToStop) {
  constexpr std::uint64_t stop_at = 10'000;
  port_.on_receive = [&] { stop_ = port_.brought >= stop_at; };
  EXPECT_EQ(run().kind, Ending::Kind::interrupted);
  EXPECT_LE(port_.brought, stop_at + Link::most_at_once);
}

}  // namespace
}  // namespace canhil::drive
