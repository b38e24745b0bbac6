// The CAN FD format on a bus: classic frames that are sent arrive unchanged and in the same order.
#include "dbc/ports/fd_groups.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <deque>
#include <fstream>

#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/transmit.hpp"
#include "messages/canhil.hpp"
#include "tests/unit/dbc/ports/frames.hpp"

namespace canhil {
namespace {

using namespace messages;
using testing::ElementsAre;
using testing::HasSubstr;

/// A wire that a test reads and writes.
class Wire final : public Port {
 public:
  SendOutcome send(const Frame& frame) override {
    if (outcome == SendOutcome::sent) sent.push_back(frame);
    return outcome;
  }
  std::optional<Received> receive() override {
    if (waiting.empty()) return std::nullopt;
    const Received first = waiting.front();
    waiting.pop_front();
    return first;
  }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {}; }
  [[nodiscard]] bool closed() const override { return false; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

  SendOutcome outcome = SendOutcome::sent;
  std::vector<Frame> sent;
  std::deque<Received> waiting;

 private:
  std::string name_ = "wire";
};

class FdGroups : public testing::Test {
 protected:
  FdGroups() {
    auto wire = std::make_unique<Wire>();
    wire_ = wire.get();
    port_ = in_fd_groups(std::move(wire));
  }

  /// The frames of one sample, all with this counter.
  static std::vector<Frame> sample(std::uint8_t counter) {
    return {to_frame(SlaveImuDeltaTheta{.delta_theta_x_rad = 1e-3}, counter),
            to_frame(SlaveImuDeltaV{.delta_v_y_mps = 0.1}, counter),
            to_frame(SlaveImuStatus{.time_of_validity_us = 10'000}, counter)};
  }
  void send(const std::vector<Frame>& frames) {
    for (const Frame& frame : frames) EXPECT_EQ(port_->send(frame), SendOutcome::sent);
  }
  /// The frames that another node receives.
  std::vector<Frame> heard() {
    for (const Frame& frame : wire_->sent) wire_->waiting.push_back({.frame = frame, .t_ns = 7});
    std::vector<Frame> frames;
    while (auto received = port_->receive()) {
      EXPECT_EQ(received->t_ns, 7);
      frames.push_back(received->frame);
    }
    return frames;
  }

  Wire* wire_;
  std::unique_ptr<Port> port_;
};

const Frame sync_frame = to_frame(Sync{.time_us = 10'000}, 3);

TEST_F(FdGroups, AGroupIsOneFrameOnTheWireAndItselfAgainBehindIt) {
  const auto frames = sample(4);
  send({frames[0], frames[1]});
  EXPECT_TRUE(wire_->sent.empty());
  send({frames[2]});
  ASSERT_EQ(wire_->sent.size(), 1U);
  const Frame& container = wire_->sent.front();
  EXPECT_EQ(container.id, SlaveImuDeltaTheta::info.id);
  EXPECT_EQ(container.size, 24);
  EXPECT_TRUE(container.fd && container.brs);
  EXPECT_EQ(heard(), frames);
}

TEST_F(FdGroups, AMessageOfNoGroupIsAnFdFrameOfItsOwn) {
  send({sync_frame});
  ASSERT_EQ(wire_->sent.size(), 1U);
  EXPECT_TRUE(wire_->sent[0].fd && wire_->sent[0].brs);
  EXPECT_EQ(heard(), std::vector{sync_frame});
}

TEST_F(FdGroups, AGroupOfFourteenGoesInTwoFrames) {
  std::vector<Frame> frames;
  for (const MessageInfo& info : all_messages) {
    if (info.sample_group == FixUpdate::info.sample_group)
      frames.push_back(frame_of(info.id, {1, 2, 3, 4, 5, 6, 7, 8}));
  }
  ASSERT_EQ(frames.size(), 14U);
  send(frames);
  ASSERT_EQ(wire_->sent.size(), 2U);
  EXPECT_EQ(wire_->sent[0].size, 64);
  EXPECT_EQ(wire_->sent[1].size, 48);
  EXPECT_EQ(heard(), frames);
}

TEST_F(FdGroups, AnyLossLeavesTheOthersInOrderWithTheirCounters) {
  for (unsigned lost = 0; lost < 64; ++lost) {  // each subset of the six frames of two samples
    wire_->sent.clear();
    std::vector<Frame> kept;
    for (std::uint8_t n = 0; n < 2; ++n) {
      for (unsigned k = 0; k < 3; ++k) {
        if ((lost >> (3 * n + k) & 1U) == 0) kept.push_back(sample(n)[k]);
      }
      kept.push_back(sync_frame);
    }
    send(kept);
    EXPECT_EQ(heard(), kept) << lost;
  }
}

TEST_F(FdGroups, AFrameThatDoesNotContinueTheGroupSendsOffWhatIsThere) {
  send({sample(1)[0], sample(2)[0]});
  ASSERT_EQ(wire_->sent.size(), 1U);
  EXPECT_EQ(wire_->sent[0].size, 24);
  EXPECT_EQ(heard(), std::vector{sample(1)[0]});
}

TEST_F(FdGroups, WhatTheWireDoesNotTakeIsNotTaken) {
  const auto frames = sample(4);
  send({frames[0], frames[1]});
  wire_->outcome = SendOutcome::queue_full;
  EXPECT_EQ(port_->send(frames[2]), SendOutcome::queue_full);
  EXPECT_EQ(port_->send(sync_frame), SendOutcome::queue_full);
  wire_->outcome = SendOutcome::down;
  EXPECT_EQ(port_->send(frames[2]), SendOutcome::down);
  wire_->outcome = SendOutcome::sent;
  send({frames[2]});
  EXPECT_EQ(wire_->sent.size(), 1U);
  EXPECT_EQ(heard(), frames);
}

TEST_F(FdGroups, OwnEchoesComeApartWithTheStampOfTheirContainer) {
  send(sample(4));
  wire_->waiting.push_back({.frame = wire_->sent[0], .t_ns = 42, .hardware_ns = 17, .own = true});
  for (const Frame& frame : sample(4)) {
    const auto echo = port_->receive();
    ASSERT_TRUE(echo);
    EXPECT_EQ(echo->frame, frame);
    EXPECT_TRUE(echo->own);
    EXPECT_EQ(echo->t_ns, 42);
    EXPECT_EQ(echo->hardware_ns, 17);
  }
  EXPECT_FALSE(port_->receive());
}

TEST_F(FdGroups, AClassicFrameOfAnotherIsForeignAndCounted) {
  wire_->waiting.push_back({.frame = sync_frame});
  const auto received = port_->receive();
  ASSERT_TRUE(received);
  EXPECT_TRUE(received->foreign);
  EXPECT_EQ(port_->counters().foreign, 1U);
  Frame trouble = frame_of(0x40, {0, 0, 0, 0, 0, 0, 0, 0});  // error frames are classic on any bus
  trouble.error = true;
  wire_->waiting.push_back({.frame = trouble});
  EXPECT_FALSE(port_->receive()->foreign);
  EXPECT_EQ(port_->counters().foreign, 1U);
}

TEST_F(FdGroups, AContainerOfAnotherSizeIsNotTakenApart) {
  Frame odd = frame_of(SlaveImuDeltaTheta::info.id);
  odd.size = 16;
  odd.fd = odd.brs = true;
  odd.data.fill(1);
  wire_->waiting.push_back({.frame = odd});
  const auto received = port_->receive();
  ASSERT_TRUE(received);
  EXPECT_EQ(received->frame, odd);
}

TEST(FdBus, BothEndsOfALocalBus) {
  const std::string bus = fmt::format("local:fd-groups-{}", getpid());
  auto hub = host_local_bus(bus, {.fd = true}).value();
  const auto node = open_bus(bus, {}, BusFormat::fd).value();
  for (int twice = 0; twice < 2; ++twice) EXPECT_FALSE(hub->receive());
  const auto host = in_fd_groups(std::move(hub));
  Outbox<3> out;
  out.send(SlaveImuDeltaTheta{});
  out.send(SlaveImuDeltaV{});
  out.send(SlaveImuStatus{.time_of_validity_us = 5});
  for (const Frame& frame : out.frames()) EXPECT_EQ(host->send(frame), SendOutcome::sent);
  for (const Frame& frame : out.frames()) {
    const auto received = next_frame(*node);
    ASSERT_TRUE(received);
    EXPECT_EQ(received->frame, frame);
  }
  EXPECT_THAT(open_bus(bus, {}, BusFormat::classic).error().message, HasSubstr("carries CAN FD"));
}

TEST(FdBus, AContractIsNamedByItsNameOrItsFile) {
  EXPECT_EQ(named_contract("canhil"), BusFormat::classic);
  EXPECT_EQ(named_contract("canhil-fd"), BusFormat::fd);
  EXPECT_EQ(named_contract(SOURCE_DIR "/dbc/canhil.dbc"), BusFormat::classic);
  EXPECT_EQ(named_contract(SOURCE_DIR "/dbc/canhil-fd.dbc"), BusFormat::fd);
  EXPECT_THAT(named_contract(TEST_DATA_DIR "/dbc/fd.dbc").error().message,
              testing::AllOf(HasSubstr("fd.dbc: hash "), HasSubstr("expected that of canhil.dbc")));
  EXPECT_THAT(named_contract("no_such.dbc").error().message, HasSubstr("no_such.dbc: cannot be read"));
}

}  // namespace
}  // namespace canhil
