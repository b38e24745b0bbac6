#include "dbc/ports/simulated_wire.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace canhil {
namespace {

using testing::ElementsAre;

constexpr wire::BitRates rates{.nominal = 500'000, .data = 2'000'000};
constexpr std::int64_t bit_ns = 2'000;
constexpr std::int64_t long_enough = 1'000'000'000'000;

Frame frame(std::uint32_t id, std::uint8_t size = 8) { return {.id = id, .size = size}; }

std::int64_t duration_ns(const Frame& f) { return wire::duration_ns(wire::bit_length(f), rates); }

/// Ids in the order in which they were sent.
std::vector<std::uint32_t> sent(SimulatedWire& wire) {
  std::vector<std::uint32_t> ids;
  while (const auto carried = wire.next(long_enough)) ids.push_back(carried->frame.id);
  return ids;
}

/// The first `times` attempts to send frames with this id fail.
Disturb failing(std::uint32_t id, int times, WireError error = {.after_ns = 20 * bit_ns}) {
  return [id, times, error, n = 0](const Attempt& attempt) mutable {
    return attempt.frame.id == id && n++ < times ? std::optional(error) : std::nullopt;
  };
}

TEST(SimulatedWire, AFrameTakesItsExactLength) {
  SimulatedWire wire(rates, std::vector<WireNode>(2));
  ASSERT_TRUE(wire.queue(0, frame(0x123), 1'000));
  const auto carried = wire.next(long_enough);
  ASSERT_TRUE(carried);
  EXPECT_EQ(carried->start_ns, 1'000);
  EXPECT_EQ(carried->end_ns, 1'000 + duration_ns(frame(0x123)));
  EXPECT_EQ(carried->delivered_ns, carried->end_ns - 3 * bit_ns);
  EXPECT_EQ(wire.counters().busy_ns, duration_ns(frame(0x123)));
}

TEST(SimulatedWire, FdFramesSwitchTheBitRate) {
  Frame fd = frame(0x123, 64);
  fd.fd = fd.brs = true;
  SimulatedWire wire(rates, std::vector<WireNode>(2));
  wire.queue(0, fd, 0);
  const wire::BitLength length = wire::bit_length(fd);
  EXPECT_EQ(wire.next(long_enough)->end_ns, length.nominal * 2'000 + length.data * 500);
}

TEST(SimulatedWire, TheLowestIdWinsAmongTheNodesWhateverTheirOrder) {
  SimulatedWire wire(rates, std::vector<WireNode>(3));
  wire.queue(0, frame(0x300), 0);
  wire.queue(1, frame(0x200), 0);
  wire.queue(2, frame(0x100), 0);
  EXPECT_THAT(sent(wire), ElementsAre(0x100, 0x200, 0x300));
}

TEST(SimulatedWire, AFifoHoldsUrgentFramesBack) {
  SimulatedWire wire(rates, {{.order = QueueOrder::fifo}, {.order = QueueOrder::priority}});
  for (const std::uint32_t id : {0x700, 0x100}) wire.queue(0, frame(id), 0);
  for (const std::uint32_t id : {0x600, 0x200}) wire.queue(1, frame(id), 0);
  EXPECT_THAT(sent(wire), ElementsAre(0x200, 0x600, 0x700, 0x100));
}

TEST(SimulatedWire, AFrameOnTheWireIsNotInterrupted) {
  SimulatedWire wire(rates, std::vector<WireNode>(2));
  wire.queue(0, frame(0x700), 0);
  wire.queue(1, frame(0x100), bit_ns);  // the first bit is over
  EXPECT_THAT(sent(wire), ElementsAre(0x700, 0x100));
}

TEST(SimulatedWire, TheArbitrationIsOpenForOneBit) {
  SimulatedWire wire(rates, std::vector<WireNode>(2));
  wire.queue(0, frame(0x700), 0);
  wire.queue(1, frame(0x100), bit_ns - 1);
  EXPECT_THAT(sent(wire), ElementsAre(0x100, 0x700));
}

TEST(SimulatedWire, SaysNothingBeforeItCanKnow) {
  SimulatedWire wire(rates, std::vector<WireNode>(2));
  EXPECT_EQ(wire.next_event_ns(), SimulatedWire::never);
  wire.queue(0, frame(0x700), 0);
  EXPECT_EQ(wire.next_event_ns(), bit_ns);
  EXPECT_FALSE(wire.next(bit_ns));
  EXPECT_EQ(wire.next_event_ns(), duration_ns(frame(0x700)));
  EXPECT_FALSE(wire.next(wire.next_event_ns() - 1));
  EXPECT_TRUE(wire.next(wire.next_event_ns()));
  EXPECT_EQ(wire.next_event_ns(), SimulatedWire::never);
}

TEST(SimulatedWire, AQueueHasAnEnd) {
  SimulatedWire wire(rates, {{.depth = 2}, {}});
  EXPECT_TRUE(wire.queue(0, frame(1), 0));
  EXPECT_TRUE(wire.queue(0, frame(2), 0));
  EXPECT_FALSE(wire.queue(0, frame(3), 0));
  ASSERT_TRUE(wire.next(long_enough));
  EXPECT_TRUE(wire.queue(0, frame(3), long_enough));
}

TEST(SimulatedWire, AnErrorFrameThenTheFrameAgain) {
  SimulatedWire wire(rates, std::vector<WireNode>(3), failing(0x123, 1));
  wire.queue(0, frame(0x123), 0);
  const auto carried = wire.next(long_enough);
  ASSERT_TRUE(carried);
  EXPECT_EQ(carried->attempts, 2);
  EXPECT_EQ(carried->start_ns, (20 + 6 + 8 + 3) * bit_ns);
  EXPECT_EQ(wire.counters().error_frames, 1);
  EXPECT_EQ(wire.transmit_errors(0), 8 - 1);
  EXPECT_EQ(wire.receive_errors(1), 0);  // +1 for the error, -1 for the success
}

TEST(SimulatedWire, AfterAnErrorTheArbitrationIsOpenAgain) {
  SimulatedWire wire(rates, std::vector<WireNode>(2), failing(0x700, 1));
  wire.queue(0, frame(0x700), 0);
  wire.queue(1, frame(0x100), 10 * bit_ns);
  EXPECT_THAT(sent(wire), ElementsAre(0x100, 0x700));
}

TEST(SimulatedWire, TheReceiverThatNoticesFirstCountsMore) {
  SimulatedWire wire(rates, std::vector<WireNode>(3), failing(0x123, 3, {.after_ns = 20 * bit_ns, .at = 1}));
  wire.queue(0, frame(0x123), 0);
  ASSERT_TRUE(wire.next(long_enough));
  EXPECT_EQ(wire.receive_errors(1), 3 * 9 - 1);
  EXPECT_EQ(wire.receive_errors(2), 3 - 1);
}

TEST(SimulatedWire, AnErrorPassiveReceiverDisturbsNobody) {
  SimulatedWire wire(rates, std::vector<WireNode>(3),
                     failing(0x123, 1000, {.after_ns = 20 * bit_ns, .at = 1}));
  wire.queue(0, frame(0x123), 0);
  const auto carried = wire.next(long_enough);
  ASSERT_TRUE(carried);
  EXPECT_EQ(carried->attempts, 16);  // 15 errors of weight 9 make 135 > 127: error passive
  // The first frame without an error sets the counter of a passive receiver to 119.
  EXPECT_EQ(wire.receive_errors(1), 119);
  EXPECT_EQ(wire.state(1), NodeState::error_active);
}

TEST(SimulatedWire, AfterSixteenErrorsASenderIsPassiveAndLetsOthersGoFirst) {
  SimulatedWire wire(rates, std::vector<WireNode>(2), failing(0x100, 16));
  wire.queue(0, frame(0x100), 0);
  wire.queue(0, frame(0x101), 0);
  const std::int64_t error_ns = (20 + 6 + 8 + 3) * bit_ns;
  const auto first = wire.next(long_enough);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->start_ns, 16 * error_ns + 8 * bit_ns);  // suspended for 8 bits
  EXPECT_EQ(wire.transmit_errors(0), 127);
  EXPECT_EQ(wire.state(0), NodeState::error_active);  // one success was enough
  EXPECT_EQ(wire.next(long_enough)->start_ns, first->end_ns);
}

TEST(SimulatedWire, WhileASenderIsSuspendedALessUrgentFrameGoes) {
  SimulatedWire wire(rates, std::vector<WireNode>(2), failing(0x100, 16));
  wire.queue(0, frame(0x100), 0);
  const std::int64_t passive_ns = 16L * (20 + 6 + 8 + 3) * bit_ns;
  ASSERT_FALSE(wire.next(passive_ns));
  EXPECT_EQ(wire.state(0), NodeState::error_passive);
  wire.queue(1, frame(0x700), passive_ns + bit_ns);
  EXPECT_THAT(sent(wire), ElementsAre(0x700, 0x100));
}

TEST(SimulatedWire, After32ErrorsOffTheBusAndBackAfter128RecessiveRuns) {
  SimulatedWire wire(rates, std::vector<WireNode>(3), failing(0x100, 1000));
  wire.queue(0, frame(0x100), 0);
  wire.queue(0, frame(0x101), 0);
  EXPECT_FALSE(wire.next(3'000'000));
  EXPECT_EQ(wire.counters().error_frames, 32);
  EXPECT_EQ(wire.state(0), NodeState::bus_off);
  EXPECT_EQ(wire.counters().dropped, 2);
  // 32 error frames of 37 bits. From the 16th error frame on, the passive sender pauses for 8 bits after each
  // error frame except the last.
  const std::int64_t off_ns = (32 * 37 + 16 * 8) * bit_ns;
  const std::int64_t back_ns = off_ns + 128 * 11L * bit_ns;
  EXPECT_FALSE(wire.queue(0, frame(0x200), back_ns - bit_ns));
  EXPECT_TRUE(wire.queue(0, frame(0x200), back_ns));
  EXPECT_EQ(wire.state(0), NodeState::error_active);
  EXPECT_EQ(wire.transmit_errors(0), 0);
  EXPECT_THAT(sent(wire), ElementsAre(0x200));
}

TEST(SimulatedWire, AFrameOfOthersCountsAsOneRecessiveRun) {
  SimulatedWire wire(rates, {{}, {.depth = 200}, {}}, failing(0x100, 32));
  wire.queue(0, frame(0x100), 0);
  for (int i = 0; i < 200; ++i) wire.queue(1, frame(0x700), bit_ns);
  // The other node's frames are sent while the passive sender pauses, and continuously while this sender is
  // bus-off.
  while (wire.state(0) != NodeState::bus_off) ASSERT_TRUE(wire.next(long_enough));
  for (int i = 0; i < 126; ++i) ASSERT_TRUE(wire.next(long_enough));
  EXPECT_EQ(wire.state(0), NodeState::bus_off);
  ASSERT_TRUE(wire.next(long_enough));  // the 128th frame since bus-off; the loop above carried the first
  EXPECT_EQ(wire.state(0), NodeState::error_active);
}

/// One report of a controller: event, counters, time.
struct Reported {
  std::optional<BusEvent> event;
  int tx = 0, rx = 0;
  std::int64_t t_ns = 0;
};
std::vector<Reported> reports(SimulatedWire& wire, std::size_t node, BusErrors& errors) {
  std::vector<Reported> reported;
  while (const auto report = wire.report()) {
    if (report->node != node) continue;
    const auto event = add(errors, report->frame);
    reported.push_back({event, errors.tx_counter, errors.rx_counter, report->t_ns});
  }
  return reported;
}
std::vector<Reported> events(std::vector<Reported> reported) {
  std::erase_if(reported, [](const Reported& t) { return !t.event; });
  return reported;
}

TEST(SimulatedWire, AControllerReportsFromTheFirstErrorToItsReturn) {
  SimulatedWire wire(rates, {{.reports_errors = true}, {}}, failing(0x100, 1000));
  wire.queue(0, frame(0x100), 0);
  BusErrors errors;
  std::vector<Reported> reported;
  while (wire.next_event_ns() != SimulatedWire::never) {
    ASSERT_FALSE(wire.next(wire.next_event_ns()));
    for (const Reported& t : reports(wire, 0, errors)) reported.push_back(t);
  }
  EXPECT_EQ(errors.bus_error, 32U);
  EXPECT_EQ(errors.no_ack, 0U);
  const auto changes = events(reported);
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(changes[0].event, BusEvent::error_warning);
  EXPECT_EQ(changes[0].tx, 96);
  EXPECT_EQ(changes[0].t_ns, (11 * 37 + 20) * bit_ns);  // the beginning of the 12th error flag
  EXPECT_EQ(changes[1].event, BusEvent::error_passive);
  EXPECT_EQ(changes[1].tx, 128);
  EXPECT_EQ(changes[2].event, BusEvent::bus_off);
  EXPECT_EQ(changes[3].event, BusEvent::restarted);
  EXPECT_EQ(changes[3].tx, 0);
  EXPECT_EQ(changes[3].t_ns, (32 * 37 + 16 * 8 + 128 * 11) * bit_ns);
  EXPECT_TRUE(wire.queue(0, frame(0x200), changes[3].t_ns));
}

TEST(SimulatedWire, AReceiverReportsItsOwnCounter) {
  SimulatedWire wire(rates, {{}, {.reports_errors = true}},
                     failing(0x123, 3, {.after_ns = 20 * bit_ns, .at = 1}));
  wire.queue(0, frame(0x123), 0);
  while (!wire.next(long_enough)) ASSERT_TRUE(wire.has_report());
  BusErrors errors;
  reports(wire, 1, errors);
  EXPECT_EQ(errors.frames, 3U);
  EXPECT_EQ(errors.protocol, 3U);
  EXPECT_EQ(errors.rx_counter_max, 27);
  EXPECT_EQ(errors.tx_counter_max, 0);
}

// 12 errors cause a warning. One successful frame ends the warning; a further frame causes no report.
TEST(SimulatedWire, TheWayBackIsReportedAfterTheFrameThatLedThere) {
  SimulatedWire wire(rates, {{.reports_errors = true}, {}}, failing(0x123, 12));
  for (int i = 0; i < 2; ++i) wire.queue(0, frame(0x123), 0);
  BusErrors errors;
  std::vector<Reported> reported;
  std::optional<Carried> carried;
  while (!(carried = wire.next(long_enough))) {
    for (const Reported& t : reports(wire, 0, errors)) reported.push_back(t);
  }
  EXPECT_EQ(reported.size(), 12U);
  const auto after = reports(wire, 0, errors);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].event, BusEvent::error_active);
  EXPECT_EQ(after[0].tx, 95);
  EXPECT_EQ(after[0].t_ns, carried->delivered_ns);
  ASSERT_TRUE(wire.next(long_enough));
  EXPECT_FALSE(wire.has_report());
}

TEST(SimulatedWire, WhatNobodyHearsIsNotAcknowledged) {
  SimulatedWire wire(rates, {{.reports_errors = true}});
  wire.queue(0, frame(0x100), 0);
  EXPECT_FALSE(wire.next(1'000'000));
  BusErrors errors;
  reports(wire, 0, errors);
  EXPECT_GT(errors.no_ack, 0U);
  EXPECT_EQ(errors.protocol, 0U);
}

TEST(SimulatedWire, AloneOnTheBusASenderGoesPassiveButNeverOff) {
  SimulatedWire wire(rates, std::vector<WireNode>(1));
  wire.queue(0, frame(0x100), 0);
  EXPECT_FALSE(wire.next(1'000'000'000));
  EXPECT_EQ(wire.state(0), NodeState::error_passive);
  EXPECT_EQ(wire.transmit_errors(0), 128);
  EXPECT_GT(wire.counters().error_frames, 1000);
  EXPECT_EQ(wire.counters().frames, 0);
}

}  // namespace
}  // namespace canhil
