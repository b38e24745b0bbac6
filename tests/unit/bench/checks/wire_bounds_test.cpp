// Measured times of frames on the bus, beside their bounds.
#include "bench/checks/wire_bounds.hpp"

#include <gmock/gmock.h>

#include "bench/checks/kinds/wire_response.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::checks {
namespace {

using messages::AlignAttitude;
using messages::SlaveImuDeltaTheta;
using messages::SlaveImuStatus;
using messages::TargetHeartbeat;
using testing::HasSubstr;

constexpr std::int64_t frame_ns = 135'000;  // a frame with 8 bytes at 1 Mbit/s

// 1 s at 1 Mbit/s: one message of the bench, one answer to it, and heartbeats.
class OnTheWire : public testing::Test {
 protected:
  OnTheWire() {
    seen_.timing.wire.rates = {.nominal = 1'000'000};
    seen_.transmit_stamps_echoed = true;
    seen_.last_ns = 1'000'000'000;
    seen_.own_interval_s = {{"AlignNav", 0.01}};
    seen_.timing.lateness.add(1);
    for (std::int64_t t_us = 10'000; t_us <= 1'000'000; t_us += 10'000) {
      seen_.stimuli["SlaveImu"].add(t_us);
      seen_.timing.transmit[message_index<SlaveImuStatus>()].handed_over.add(0);
    }
    seen_.timing.responses[message_index<SlaveImuStatus>()] = {.count = 100, .max_ns = 200'000};
    seen_.timing.responses[message_index<AlignAttitude>()] = {.count = 100, .max_ns = frame_ns};
    seen_.timing.answers[message_index<AlignAttitude>()].last_ns = 1;
    heartbeats(1);
  }
  void heartbeats(std::uint64_t together) {
    AnswerTiming& timing = seen_.timing.answers[message_index<TargetHeartbeat>()];
    timing.last_ns = 1;
    timing.count = 10 * together;
  }
  [[nodiscard]] std::int64_t bound_of(std::string_view message) const {
    const auto all = wire_bounds(seen_);
    const auto found = std::ranges::find(all, message, &WireBound::message);
    return found == all.end() || !found->bound_ns ? -1 : *found->bound_ns;
  }

  Observations seen_;
};

// A frame of the bench can wait for an answer or heartbeat that is already on the wire; an answer or
// heartbeat with a lower id also wins the arbitration. In the target, an answer can be queued behind the
// heartbeat, or the heartbeat behind an answer.
TEST_F(OnTheWire, TheBoundIsOfTheMessagesThatWereSeen) {
  EXPECT_EQ(wire_bounds(seen_).size(), 2U) << "of the heartbeat nobody saw when it was queued";
  EXPECT_EQ(bound_of("SlaveImuStatus"), 2 * frame_ns);
  EXPECT_EQ(bound_of("AlignAttitude"), 3 * frame_ns);
  heartbeats(4);  // a target with four estimators
  EXPECT_EQ(bound_of("AlignAttitude"), 6 * frame_ns);
}

TEST_F(OnTheWire, TheBoundIsThatOfTheOrderInWhichNodesSend) {
  heartbeats(4);
  // A heartbeat can be on the wire already, but in the queue no heartbeat is ahead of the answer.
  seen_.timing.wire.urgent_first = true;
  EXPECT_EQ(bound_of("SlaveImuStatus"), 2 * frame_ns);
  EXPECT_EQ(bound_of("AlignAttitude"), 3 * frame_ns);
}

TEST_F(OnTheWire, ACheckHoldsEveryMessageAgainstItsBound) {
  EXPECT_EQ(found(WireResponseRule{}, seen_).outcome, Outcome::pass);
  EXPECT_EQ(found(WireResponseRule{}, seen_).measured,
            "SlaveImuStatus: 0.200 of 0.270 ms, the most of 2 messages");
  seen_.timing.responses[message_index<AlignAttitude>()].max_ns = 3 * frame_ns + 1;
  EXPECT_EQ(found(WireResponseRule{}, seen_).outcome, Outcome::fail);
  EXPECT_THAT(found(WireResponseRule{}, seen_).measured, HasSubstr("AlignAttitude: 0.405 of 0.405 ms"));
}

TEST_F(OnTheWire, WithoutABoundNothingIsMeasured) {
  const auto judged = [&] { return found(WireResponseRule{}, seen_); };
  seen_.bus.errors.frames = 3;
  EXPECT_EQ(judged().outcome, Outcome::not_measured);
  EXPECT_EQ(judged().measured, "3 errors on the bus");
  seen_.bus.errors.frames = 0;
  seen_.transmit_stamps_echoed = false;
  EXPECT_THAT(judged().measured, HasSubstr("does not echo"));
  seen_.transmit_stamps_echoed = true;
  seen_.timing.wire.rates.nominal = 10'000;  // 13.5 ms per frame: overloaded
  EXPECT_EQ(judged().outcome, Outcome::not_measured);
  EXPECT_THAT(judged().measured, HasSubstr("has no bound"));
  seen_.timing.wire.rates.nominal = 0;
  EXPECT_EQ(judged().outcome, Outcome::not_measured);
  EXPECT_EQ(judged().measured, "the bit rate of this bus is not known");
  EXPECT_TRUE(wire_bounds(seen_).empty());
}

// Three messages in each direction, in a container of 24 bytes: 20 + 12 bits (before and after the data
// phase) at the nominal bit rate, and 246 + 33 bits (data and CRC field) at the data bit rate. The heartbeat
// with 8 bytes has 86 + 28 bits at the data bit rate.
TEST_F(OnTheWire, OnCanFdTheBoundIsThatOfTheContainer) {
  constexpr std::int64_t container_ns = 32'000 + 69'750, heartbeat_ns = 32'000 + 28'500;
  seen_.timing.wire = {.rates = {.nominal = 1'000'000, .data = 4'000'000}, .fd = true};
  seen_.timing.responses = {};
  WireResponse& sent = seen_.timing.responses[message_index<SlaveImuDeltaTheta>()];
  WireResponse& answered = seen_.timing.responses[message_index<AlignAttitude>()];
  sent = {.count = 100, .max_ns = 150'000};
  answered = {.count = 100, .max_ns = container_ns};
  EXPECT_EQ(wire_bounds(seen_).size(), 2U);
  EXPECT_EQ(bound_of("SlaveImu"), 2 * container_ns);
  EXPECT_EQ(bound_of("AlignNav"), 2 * container_ns + heartbeat_ns);
  EXPECT_EQ(found(WireResponseRule{}, seen_).outcome, Outcome::pass);
  EXPECT_THAT(found(WireResponseRule{}, seen_).measured, HasSubstr("SlaveImu: 0.150 of 0.20"));
  sent.max_ns = 2 * container_ns + 1;  // longer than the bound of two containers
  EXPECT_EQ(found(WireResponseRule{}, seen_).outcome, Outcome::fail);
  sent.max_ns = 150'000;
  answered.max_ns = 2 * container_ns + heartbeat_ns + 1;
  EXPECT_EQ(found(WireResponseRule{}, seen_).outcome, Outcome::fail);
}

TEST_F(OnTheWire, WhatIsSentFasterThanTheContractSaysCountsAsOften) {
  seen_.stimuli["SlaveImu"] = {.count = 4001, .first_us = 0, .last_us = 1'000'000};  // every 250 us
  EXPECT_EQ(bound_of("SlaveImuStatus"), 3 * frame_ns) << "the one before it may still wait";
  seen_.stimuli["SlaveImu"].last_us = 500'000;  // every 125 us: shorter than a frame
  EXPECT_EQ(bound_of("SlaveImuStatus"), -1);
}

}  // namespace
}  // namespace canhil::checks
