// Timing on CAN FD: the times of the containers that carry the messages.
#include <gtest/gtest.h>

#include <utility>

#include "bench/protocol/monitor.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/carriers.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;

/// A node of an FD bus: its messages are sent in containers.
class FdNode {
 public:
  template <class... Messages>
  void send(const Messages&... messages) {
    (put(messages), ...);
  }
  std::vector<Frame> take_messages() { return std::exchange(messages_, {}); }
  std::vector<Frame> take_on_wire() { return std::exchange(on_wire_, {}); }

 private:
  template <class Message>
  void put(const Message& message) {
    out_.clear();
    out_.send(message);
    const Frame frame = out_.frames().front();
    messages_.push_back(frame);
    if (const auto due = packer_.due_before(frame)) {
      on_wire_.push_back(*due);
      packer_.clear();
    }
    if (const auto full = packer_.put(frame)) on_wire_.push_back(*full);
  }

  Outbox<1> out_;
  FdPacker packer_;
  std::vector<Frame> messages_, on_wire_;
};

/// A run as the monitor sees it: the messages of each container, with the stamp of the container.
class OnAnFdWire : public testing::Test {
 protected:
  static constexpr wire::BitRates rates{.nominal = 1'000'000, .data = 4'000'000};
  static std::int64_t ns(const Frame& on_wire) { return wire::duration_ns(wire::bit_length(on_wire), rates); }
  /// The bench hands over its messages, one every 10 us.
  void hand_over(std::int64_t t_ns) {
    for (const Frame& frame : bench_.take_messages()) monitor_.transmitted(frame, t_ns += 10'000, 0);
  }
  void come(const Frame& on_wire, std::int64_t t_ns, bool own) {
    const FdUnpacked unpacked(on_wire);
    for (const Frame& frame : unpacked.frames())
      monitor_.received({.frame = frame, .t_ns = t_ns, .own = own});
  }
  [[nodiscard]] const checks::TimingRecord& timing() const { return monitor_.observations().timing; }
  template <class Message>
  [[nodiscard]] const checks::WireResponse& response() const {
    return timing().responses[message_index<Message>()];
  }

  FdNode bench_, target_;
  Monitor monitor_{Asked{.wire = {.rates = rates, .fd = true}}};
};

TEST_F(OnAnFdWire, TheLatencyIsSplitIntoTheTimesOfContainers) {
  bench_.send(SlaveImuDeltaTheta{}, SlaveImuDeltaV{}, SlaveImuStatus{.time_of_validity_us = 10'000});
  hand_over(1'000'000);
  const Frame stimulus = bench_.take_on_wire().at(0);
  const std::int64_t echo_ns = 1'030'000 + 50'000 + ns(stimulus) - 3'000;  // stamped before the intermission
  come(stimulus, echo_ns, true);
  target_.send(AlignAttitude{}, AlignVelocityNE{}, AlignVelocityD{.cause_time_us = 10'000});
  const Frame reply = target_.take_on_wire().at(0);
  come(reply, echo_ns + 70'000 + ns(reply), false);

  const checks::LatencyBreakdown& breakdown = timing().breakdown;
  EXPECT_EQ(breakdown.stimuli, 1U);
  EXPECT_EQ(breakdown.echoed, 1U);
  EXPECT_EQ(breakdown.stimulus_wire_ns, ns(stimulus) - 3'000);
  EXPECT_EQ(breakdown.to_echo_ns - breakdown.stimulus_wire_ns, 50'000) << "the wait";
  EXPECT_EQ(breakdown.reply_wire_ns, ns(reply)) << "once, not for each message";
  EXPECT_EQ(breakdown.latency_ns - breakdown.reply_wire_ns, 70'000) << "the target and its waits";
  for (const std::size_t index : {message_index<AlignAttitude>(), message_index<AlignVelocityD>()})
    EXPECT_EQ(timing().answers[index].reply_wire_ns, ns(reply));

  EXPECT_EQ(response<SlaveImuDeltaTheta>().count, 1U);
  EXPECT_EQ(response<SlaveImuDeltaTheta>().max_ns, 50'000 + ns(stimulus) - 3'000);
  EXPECT_EQ(response<SlaveImuStatus>().count, 0U);
  EXPECT_EQ(response<AlignAttitude>().count, 1U);
  EXPECT_EQ(response<AlignAttitude>().max_ns, ns(reply));
  EXPECT_EQ(response<AlignVelocityD>().count, 0U);
}

// The answer has nine messages: eight in a container, the ninth in a separate frame that is delayed by 2 ms.
TEST_F(OnAnFdWire, TheFramesOfAnAnswerCountOneBehindTheOther) {
  bench_.send(MasterInsVelocityNE{}, MasterInsAttitude{}, MasterInsLatitude{}, MasterInsLongitude{},
              MasterInsVelocityD{.time_of_validity_us = 20'000});
  hand_over(0);
  const Frame stimulus = bench_.take_on_wire().at(0);
  come(stimulus, 300'000, true);
  target_.send(AlignInnovation{}, AlignAttitudeSigma{}, AlignAttitudeCorrelation{}, AlignVelocitySigma{},
               AlignGyroBias{}, AlignGyroBiasSigma{}, AlignAccelBias{}, AlignAccelBiasSigma{},
               AlignUpdate{.cause_time_us = 20'000});
  const std::vector<Frame> reply = target_.take_on_wire();
  ASSERT_EQ(reply.size(), 2U);
  come(reply[0], 1'000'000, false);
  come(reply[1], 3'000'000 + ns(reply[1]), false);
  EXPECT_EQ(response<AlignInnovation>().max_ns, ns(reply[0]));
  EXPECT_EQ(response<AlignUpdate>().max_ns, ns(reply[0]) + 2'000'000 + ns(reply[1]));
  EXPECT_EQ(timing().breakdown.reply_wire_ns, ns(reply[0]) + ns(reply[1]));
  EXPECT_EQ(timing().breakdown.latency_ns, 2'700'000 + ns(reply[1]));
}

// An incomplete container is not sent before a frame of another kind follows, so the time at which it was
// queued is unknown.
TEST_F(OnAnFdWire, AContainerWithoutItsLastMessageHasNoResponse) {
  bench_.send(SlaveImuDeltaTheta{}, SlaveImuDeltaV{}, Sync{}, SlaveImuDeltaTheta{}, SlaveImuDeltaV{},
              SlaveImuStatus{});
  hand_over(0);
  const std::vector<Frame> on_wire = bench_.take_on_wire();
  ASSERT_EQ(on_wire.size(), 3U);
  std::int64_t t_ns = 100'000;
  for (const Frame& frame : on_wire) come(frame, t_ns += 100'000, true);
  EXPECT_EQ(response<Sync>().count, 1U);
  EXPECT_EQ(response<SlaveImuDeltaTheta>().count, 1U) << "the whole one";
  EXPECT_EQ(response<SlaveImuDeltaTheta>().max_ns, 400'000 - 60'000);
}

TEST(Carriers, AreTheFramesOfTheContract) {
  const auto classic = wire::carriers_of(all_messages, false);
  for (std::size_t i = 0; i < all_messages.size(); ++i) {
    EXPECT_EQ(classic[i].first, i);
    EXPECT_EQ(classic[i].name, all_messages[i].name);
  }
  const auto fd = wire::carriers_of(all_messages, true);
  EXPECT_EQ(fd[message_index<SlaveImuStatus>()].first, message_index<SlaveImuDeltaTheta>());
  EXPECT_EQ(fd[message_index<SlaveImuStatus>()].name, "SlaveImu");
  EXPECT_EQ(fd[message_index<SlaveImuStatus>()].longest, wire::worst_case_fd_length(24, false, true));
  EXPECT_EQ(fd[message_index<FixUpdate>()].name, "FixFilter2");
  EXPECT_EQ(fd[message_index<AlignUpdate>()].first, message_index<AlignUpdate>());
  EXPECT_EQ(fd[message_index<AlignUpdate>()].name, "AlignUpdate");
  EXPECT_EQ(fd[message_index<Sync>()].longest, wire::worst_case_fd_length(8, false, true));
}

}  // namespace
}  // namespace canhil::protocol
