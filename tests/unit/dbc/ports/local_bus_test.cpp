#include "dbc/ports/local_bus.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <thread>
#include <utility>
#include <vector>

#include "dbc/ports/local_place.hpp"
#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A bus whose name contains the test's name and the process id, so that no other test uses it.
class LocalBus : public ::testing::Test {
 protected:
  std::unique_ptr<LocalHub> host(const PortOptions& options = {}) const {
    auto hub = host_local_bus(bus_, options, {.reading_limit_ns = patient_ns});
    EXPECT_TRUE(hub) << hub.error().message;
    return hub ? std::move(*hub) : nullptr;
  }
  /// Joins the bus and lets the hub accept the node.
  std::unique_ptr<Port> join(Port& hub, const PortOptions& options = {}) const {
    auto node = open_port(bus_, options);
    EXPECT_TRUE(node) << node.error().message;
    for (int twice = 0; twice < 2; ++twice) EXPECT_FALSE(hub.receive());
    return node ? std::move(*node) : nullptr;
  }
  std::string why_not(const PortOptions& options = {}) const {
    const auto node = open_port(bus_, options);
    return node ? "joined" : node.error().message;
  }
  /// Sends numbered frames until the port has no room. Returns their number.
  static std::uint32_t fill(Port& port, std::uint32_t id) {
    std::uint32_t n = 0;
    while (port.send(numbered(id, n)) == SendOutcome::sent) ++n;
    return n;
  }

  // local_gate_test.cpp tests which nodes the hub drops. Here, a slow machine must not cause a drop.
  static constexpr std::int64_t patient_ns = 600'000'000'000;
  const std::string bus_ = fmt::format("local:test-{}-{}", ::getpid(),
                                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(LocalBus, TakesSeveralFramesInOneCall) {
  const auto hub = host({.own_echo = true});
  const auto node = join(*hub);
  std::vector<Frame> frames;
  for (std::uint32_t n = 0; n < 40; ++n) frames.push_back(numbered(0x111, n));
  for (const auto& [from, to] : {std::pair(node.get(), static_cast<Port*>(hub.get())),
                                 std::pair(static_cast<Port*>(hub.get()), node.get())}) {
    const std::uint64_t before = from->counters().sent;
    ASSERT_EQ(from->send_all(frames), frames.size());
    EXPECT_EQ(from->counters().sent, before + frames.size());
    for (const Frame& frame : frames) {
      const auto received = next_frame(*to);
      ASSERT_TRUE(received);
      EXPECT_EQ(received->frame, frame);
      EXPECT_FALSE(received->own);
    }
  }
  for (const Frame& frame : frames) {
    const auto echo = hub->receive();
    ASSERT_TRUE(echo && echo->own);
    EXPECT_EQ(echo->frame, frame);
  }

  const Frame fd{.id = 0x111, .size = 12, .fd = true};  // this bus cannot carry it
  frames[21] = fd;
  EXPECT_EQ(node->send_all(frames), 21U);
  EXPECT_EQ(hub->send_all(frames), 21U);
}

TEST_F(LocalBus, TellsHowManyOfSeveralFramesHadRoom) {
  const auto hub = host();
  const auto node = join(*hub);
  for (const auto& [from, to] : {std::pair(node.get(), static_cast<Port*>(hub.get())),
                                 std::pair(static_cast<Port*>(hub.get()), node.get())}) {
    const std::uint32_t sent = fill(*from, 0x111);
    std::uint32_t received = 0;
    for (; received < 3; ++received) ASSERT_EQ(number_of(next_frame(*to).value().frame), received);
    std::vector<Frame> more;
    for (std::uint32_t n = 0; n < 400; ++n) more.push_back(numbered(0x111, sent + n));
    const std::size_t accepted = from->send_all(more);
    EXPECT_LT(accepted, more.size());
    std::size_t next = accepted;
    const auto take_all = [&, to = to] {
      for (; received < sent + next; ++received)
        ASSERT_EQ(number_of(next_frame(*to).value().frame), received);
    };
    take_all();
    while (next < more.size()) {  // what had no room has it later, in order
      const std::size_t again = from->send_all(std::span(more).subspan(next));
      ASSERT_GT(again, 0U);
      next += again;
      take_all();
    }
    EXPECT_EQ(received, sent + more.size());
    EXPECT_FALSE(to->receive());
  }
}

TEST_F(LocalBus, CarriesFramesBothWaysWithTheHubsStamp) {
  const auto hub = host();
  const auto node = join(*hub);
  const std::int64_t before = clock_ns(CLOCK_MONOTONIC);
  const Frame there = frame_of(0x123, {1, 2, 3});
  ASSERT_EQ(hub->send(there), SendOutcome::sent);
  const auto at_node = next_frame(*node);
  ASSERT_TRUE(at_node);
  EXPECT_EQ(at_node->frame, there);
  EXPECT_EQ(at_node->source, StampSource::hub);
  EXPECT_FALSE(at_node->own);
  EXPECT_GE(at_node->t_ns, before);
  EXPECT_LE(at_node->t_ns, clock_ns(CLOCK_MONOTONIC));

  Frame back = frame_of(0x1ABCDEF0, {});
  back.extended = true;
  ASSERT_EQ(node->send(back), SendOutcome::sent);
  const auto at_hub = next_frame(*hub);
  ASSERT_TRUE(at_hub);
  EXPECT_EQ(at_hub->frame, back);
  EXPECT_EQ(at_hub->source, StampSource::hub);
  EXPECT_GE(at_hub->t_ns, at_node->t_ns);
  EXPECT_EQ(hub->stamp_clock(), CLOCK_MONOTONIC);
  EXPECT_EQ(node->stamp_clock(), CLOCK_MONOTONIC);
  EXPECT_EQ(node->name(), bus_);
  EXPECT_EQ(hub->counters().sent, 1U);
  EXPECT_EQ(hub->counters().received, 1U);
  EXPECT_EQ(node->counters().sent, 1U);
  EXPECT_EQ(node->counters().received, 1U);
}

TEST_F(LocalBus, ForwardsBetweenNodesButNotToTheSender) {
  const auto hub = host();
  const auto a = join(*hub);
  const auto b = join(*hub);
  a->send(frame_of(1));
  ASSERT_TRUE(next_frame(*hub));
  EXPECT_EQ(next_frame(*b)->frame.id, 1U);
  EXPECT_FALSE(a->receive());
}

TEST_F(LocalBus, GivesNodesTheirNamesAndForgetsTheDead) {
  const auto hub = host();
  const auto a = join(*hub, {.node_name = "target"});
  auto b = join(*hub, {.node_name = std::string(100, 'x')});
  EXPECT_THAT(hub->nodes(), ElementsAre("target", std::string(65, 'x')));
  b->send(frame_of(7));
  b.reset();
  EXPECT_EQ(hub->send(frame_of(8)), SendOutcome::sent);
  EXPECT_EQ(next_frame(*hub)->frame.id, 7U);  // the hub delivers what a node sent before closing
  EXPECT_FALSE(hub->receive());
  EXPECT_THAT(hub->nodes(), ElementsAre("target"));
}

TEST_F(LocalBus, EchoesOwnFramesWithTheirStampInBusOrder) {
  const auto hub = host({.own_echo = true});
  const auto a = join(*hub, {.own_echo = true});
  const auto b = join(*hub);
  a->send(frame_of(1));
  ASSERT_EQ(next_frame(*hub)->frame.id, 1U);
  hub->send(frame_of(2));
  const auto echo = next_frame(*hub);
  ASSERT_TRUE(echo);
  EXPECT_EQ(echo->frame.id, 2U);
  EXPECT_TRUE(echo->own);

  const auto own = next_frame(*a);
  const auto other = next_frame(*a);
  ASSERT_TRUE(own && other);
  EXPECT_EQ(own->frame.id, 1U);
  EXPECT_TRUE(own->own);
  EXPECT_EQ(other->frame.id, 2U);
  EXPECT_FALSE(other->own);
  EXPECT_EQ(other->t_ns, echo->t_ns);
  const auto at_b = next_frame(*b);
  EXPECT_FALSE(at_b->own);
  EXPECT_EQ(at_b->t_ns, own->t_ns);
  EXPECT_FALSE(wait(*hub, WaitFor::frame, 0)) << "readable with nothing to read";
}

TEST_F(LocalBus, FiltersStandardIdsAndLetsErrorFramesPass) {
  const auto hub = host({.only_ids = {0x700}});
  const auto node = join(*hub, {.only_ids = {0x100, 0x7FF}});
  Frame extended = frame_of(0x100);
  extended.extended = true;
  Frame error = frame_of(0x40, {0, 0, 0, 0, 0, 0, 0, 0});
  error.error = true;
  for (const Frame& frame : {frame_of(0x101), extended, frame_of(0x7FF), error, frame_of(0x100)})
    hub->send(frame);
  EXPECT_EQ(next_frame(*node)->frame.id, 0x7FFU);
  EXPECT_EQ(next_frame(*node)->frame, error);
  EXPECT_EQ(next_frame(*node)->frame.id, 0x100U);
  EXPECT_EQ(node->counters().error_frames, 1U);
  for (const Frame& frame : {frame_of(0x6FF), frame_of(0x700)}) node->send(frame);
  EXPECT_EQ(next_frame(*hub)->frame.id, 0x700U);
}

TEST_F(LocalBus, CarriesFdOnlyWhereHostedSo) {
  Frame frame = frame_of(0x10);
  frame.fd = true;
  frame.brs = frame.esi = true;
  frame.size = 64;
  frame.data.fill(0xA5);
  const auto hub = host({.fd = true});
  const auto node = join(*hub, {.fd = true});
  ASSERT_EQ(hub->send(frame), SendOutcome::sent);
  EXPECT_EQ(next_frame(*node)->frame, frame);
  EXPECT_EQ(why_not(), "bus '" + bus_ + "' carries CAN FD and this node is classic: join with FD");
  frame.size = 63;
  EXPECT_EQ(node->send(frame), SendOutcome::refused);
}

TEST_F(LocalBus, RefusesFdOnAClassicBus) {
  const auto hub = host();
  const auto node = join(*hub);
  EXPECT_THAT(why_not({.fd = true}), HasSubstr("is classic CAN and this node wants CAN FD"));
  Frame frame = frame_of(0x10);
  frame.fd = true;
  EXPECT_EQ(hub->send(frame), SendOutcome::refused);
  EXPECT_EQ(node->send(frame), SendOutcome::refused);
  EXPECT_EQ(node->send(frame_of(0x800)), SendOutcome::refused);
}

TEST_F(LocalBus, SaysWhoMustHostAndThatOneDoes) {
  EXPECT_EQ(
      why_not(),
      fmt::format("no bus '{0}': nobody hosts it in {1}; start `hil-bench` first or `hil-bench bus {0}`",
                  bus_, local::directory().value()));
  auto hub = host();
  const auto second = host_local_bus(bus_, {.fd = true});
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("is hosted already"));
  hub.reset();
  EXPECT_TRUE(host_local_bus(bus_, {}));
}

TEST(LocalBusName, IsChecked) {
  const std::string long_name(65, 'a');
  for (const std::string& bus :
       {std::string("local:"), std::string("local:a b"), std::string("local:../x"), "local:" + long_name}) {
    const auto port = open_port(bus, {});
    ASSERT_FALSE(port);
    EXPECT_EQ(port.error().message,
              fmt::format("'{}': expected local:NAME, NAME of 1 to 64 letters, digits, '_' or '-'", bus));
    EXPECT_FALSE(host_local_bus(bus, {}));
  }
  EXPECT_TRUE(host_local_bus("local:" + long_name.substr(1), {}));
  const auto port = open_port("local:x", {.only_ids = {0x800}});
  EXPECT_EQ(port.error().message, "only_ids: 0x800 is not a standard id (0 to 0x7FF)");
}

TEST_F(LocalBus, AStuckNodeHoldsTheBusUpAndNothingIsLost) {
  const auto hub = host();
  const auto stuck = join(*hub, {.node_name = "stuck"});
  const auto reader = join(*hub, {.node_name = "reader"});
  std::uint32_t sent = 0;
  std::uint32_t read = 0;
  while (hub->send(numbered(1, sent)) == SendOutcome::sent) {
    ++sent;
    while (const auto got = reader->receive()) ASSERT_EQ(number_of(got->frame), read++);
  }
  EXPECT_EQ(read, sent);  // including the frame that is pending for the stuck node
  EXPECT_EQ(hub->held_up_by(), "stuck");
  EXPECT_FALSE(wait(*hub, WaitFor::room, 0));
  reader->send(frame_of(9));
  EXPECT_FALSE(hub->receive()) << "it could not be forwarded";
  EXPECT_FALSE(wait(*hub, WaitFor::frame, 0)) << "a host that waits must not spin";

  for (std::uint32_t n = 0; n < sent / 2; ++n) ASSERT_EQ(number_of(next_frame(*stuck)->frame), n);
  while (stuck->receive()) ++read;
  EXPECT_TRUE(wait(*hub, WaitFor::room, 0));
  EXPECT_EQ(hub->send(numbered(1, sent)), SendOutcome::sent);
  EXPECT_EQ(number_of(next_frame(*stuck)->frame), sent - 1);  // the pending frame comes first
  EXPECT_EQ(number_of(next_frame(*stuck)->frame), sent);
  EXPECT_EQ(next_frame(*hub)->frame.id, 9U);
  EXPECT_EQ(next_frame(*stuck)->frame.id, 9U);
}

TEST_F(LocalBus, ANodeThatDiesStuckSetsTheBusFree) {
  const auto hub = host();
  auto stuck = join(*hub);
  const auto reader = join(*hub);
  std::uint32_t read = 0;
  for (std::uint32_t n = 0; hub->send(numbered(1, n)) == SendOutcome::sent; ++n) {
    while (reader->receive()) ++read;
  }
  stuck.reset();
  EXPECT_TRUE(wait(*hub, WaitFor::room, in_seconds(5)));
  EXPECT_EQ(hub->send(numbered(1, read)), SendOutcome::sent);
  EXPECT_EQ(number_of(next_frame(*reader)->frame), read);
  EXPECT_FALSE(hub->receive());
  EXPECT_EQ(hub->nodes().size(), 1U);
}

TEST_F(LocalBus, AHubThatDoesNotReadIsBackPressureForNodes) {
  const auto hub = host();
  const auto node = join(*hub);
  const std::uint32_t sent = fill(*node, 5);
  EXPECT_GT(sent, 0U);
  EXPECT_FALSE(wait(*node, WaitFor::room, 0));
  for (std::uint32_t n = 0; n < sent; ++n) ASSERT_EQ(number_of(next_frame(*hub)->frame), n);
  EXPECT_TRUE(wait(*node, WaitFor::room, 0));
}

TEST_F(LocalBus, TheEndOfTheHubClosesNodesAfterTheirLastFrame) {
  auto hub = host();
  const auto node = join(*hub);
  hub->send(frame_of(3));
  node->send(frame_of(4));  // the hub does not read this frame, so the connection is reset at the end
  hub.reset();
  EXPECT_TRUE(wait(*node, WaitFor::frame, 0));
  EXPECT_EQ(node->receive()->frame.id, 3U);
  EXPECT_FALSE(node->closed());
  EXPECT_FALSE(node->receive());
  EXPECT_TRUE(node->closed());
  EXPECT_EQ(node->send(frame_of(4)), SendOutcome::down);
}

TEST_F(LocalBus, IsServedByRunHub) {
  const auto hub = host();
  std::atomic<bool> stop = false;
  std::thread server([&] { run_hub(*hub, [&] { return stop.load(); }); });
  const auto a = std::move(*open_port(bus_, {}));
  const auto b = std::move(*open_port(bus_, {.own_echo = true}));
  b->send(frame_of(1));
  EXPECT_TRUE(next_frame(*b)->own);  // the echo shows that the hub has accepted both nodes
  a->send(frame_of(2));
  EXPECT_EQ(next_frame(*b)->frame.id, 2U);
  stop = true;
  server.join();
}

}  // namespace
}  // namespace canhil
