// A run in virtual time over a simulated wire is exact and reproducible, and its times are within the bounds
// of the analysis.
#include "bench/drive/in_process_wire.hpp"
#include "bench/checks/kinds/bus_errors.hpp"
#include "bench/estimators/transfer_alignment/answers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/checks/wire_bounds.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/in_process_port.hpp"
#include "bench/drive/session.hpp"
#include "bench/schedulability/message_set.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/unit/bench/checks/judged.hpp"

namespace canhil::drive {
namespace {

using Flown = Run;  // in a test, the name Run means a member function of gtest

scenario::Scenario scenario_of(const std::string& name) {
  auto read = scenario::read_file(fmt::format("{}/bench/flights/{}.toml", SOURCE_DIR, name), contract());
  EXPECT_TRUE(read) << read.error().message;
  return *read;
}

Flown fly(const scenario::Scenario& scenario, const std::string& bus, BusFormat format = BusFormat::classic) {
  static const std::atomic<bool> never = false;
  Options options;
  options.bus = BusName(bus);
  options.format = format;
  auto flown = canhil::drive::run(scenario, options, never, [](std::int64_t) {});
  EXPECT_TRUE(flown) << flown.error().message;
  EXPECT_EQ(flown->ending.kind, Ending::Kind::completed) << flown->ending.detail;
  return std::move(*flown);
}
Flown quick(const std::string& bus) { return fly(scenario_of("transfer_alignment_quick"), bus); }

const checks::CheckResult* find_check(const Flown& run, std::string_view kind) {
  const auto found = std::ranges::find(run.verdict.checks, kind, &checks::CheckResult::kind);
  return found == run.verdict.checks.end() ? nullptr : &*found;
}

/// The first and last stamp of a run, and for each message the stamp of its last answer and its histograms of
/// latency, jitter and transmit echo.
std::vector<std::int64_t> stamps(const Flown& run) {
  std::vector<std::int64_t> t_ns{run.seen.first_ns, run.seen.last_ns};
  for (std::size_t i = 0; i < messages::all_messages.size(); ++i) {
    const checks::AnswerTiming& answers = run.seen.timing.answers[i];
    t_ns.push_back(answers.last_ns.value_or(-1));
    for (const checks::Histogram* h :
         {&answers.latency, &answers.jitter, &run.seen.timing.transmit[i].echoed}) {
      t_ns.insert(t_ns.end(), {h->min_ns(), h->max_ns()});
      for (const auto& bucket : h->buckets())
        t_ns.insert(t_ns.end(), {bucket.from_us, static_cast<std::int64_t>(bucket.count)});
    }
  }
  return t_ns;
}

void expect_same_estimates(const Flown& a, const Flown& b) {
  ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().navigation.size(),
            b.seen.of<estimators::TransferAnswers>().navigation.size());
  ASSERT_GT(a.seen.of<estimators::TransferAnswers>().navigation.size(), 200U);
  for (std::size_t i = 0; i < a.seen.of<estimators::TransferAnswers>().navigation.size(); ++i) {
    ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().navigation[i].cause_us,
              b.seen.of<estimators::TransferAnswers>().navigation[i].cause_us);
    ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().navigation[i].v_eb_n,
              b.seen.of<estimators::TransferAnswers>().navigation[i].v_eb_n);
    ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().navigation[i].angles.heading,
              b.seen.of<estimators::TransferAnswers>().navigation[i].angles.heading);
  }
  ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().filter.size(),
            b.seen.of<estimators::TransferAnswers>().filter.size());
  for (std::size_t i = 0; i < a.seen.of<estimators::TransferAnswers>().filter.size(); ++i)
    ASSERT_EQ(a.seen.of<estimators::TransferAnswers>().filter[i].nis,
              b.seen.of<estimators::TransferAnswers>().filter[i].nis);
}

constexpr std::string_view at_500k = "in-process?bitrate=500000";

TEST(InProcessWire, WhichBusHasWhichClock) {
  const InProcessPort without(Rounding::as_on_the_bus);
  EXPECT_EQ(clock_of(without.capabilities().time, false), ClockKind::lockstep);
  const InProcessWire wire("x", {.rates = {.nominal = 500'000}}, BusFormat::classic);
  EXPECT_EQ(clock_of(wire.capabilities().time, false), ClockKind::simulated_wire);
  EXPECT_EQ(clock_of(wire.capabilities().time, true), ClockKind::simulated_wire);
  EXPECT_EQ(clock_of(BusTime::host, false), ClockKind::real_time);
  EXPECT_EQ(clock_of(BusTime::host, true), ClockKind::lockstep);
  EXPECT_TRUE(BusName(std::string(at_500k)).in_process);
  EXPECT_FALSE(BusName("in-processor").in_process);
}

TEST(InProcessWire, TimingIsJudgedAndTheSameEachTime) {
  const Flown run = quick(std::string(at_500k));
  EXPECT_EQ(run.verdict.outcome, checks::Outcome::pass) << run.verdict.reason;
  ASSERT_NE(find_check(run, "latency"), nullptr);
  EXPECT_EQ(find_check(run, "latency")->outcome, checks::Outcome::pass);
  EXPECT_TRUE(run.seen.transmit_stamps_echoed);
  EXPECT_EQ(run.seen.timing.lateness.max_ns(), 0);
  EXPECT_EQ(stamps(run), stamps(quick(std::string(at_500k))));
  expect_same_estimates(run, quick("in-process"));
}

// At half the bit rate, every frame and every answer takes twice as long.
TEST(InProcessWire, LatencyIsTheShareOfTheWire) {
  const std::size_t index = message_index<messages::AlignVelocityD>();
  const auto latency_ns = [&](const std::string& bus) {
    return quick(bus).seen.timing.answers[index].latency.min_ns();
  };
  const std::int64_t at_1m = latency_ns("in-process?bitrate=1000000");
  EXPECT_EQ(latency_ns(std::string(at_500k)), 2 * at_1m);
  // Three frames; the last one is stamped at its end, without its intermission.
  const wire::BitRates rates{.nominal = 1'000'000};
  const std::int64_t least_ns = 3 * wire::duration_ns({.nominal = 8 * 8 + 47}, rates) - 3'000;
  const std::int64_t most_ns = 3 * wire::duration_ns(wire::worst_case_length(8, false), rates) - 3'000;
  EXPECT_GE(at_1m, least_ns);
  EXPECT_LE(at_1m, most_ns);
}

TEST(InProcessWire, NoFrameTakesLongerThanItsBound) {
  const auto database = dbc::read_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(database) << database.error().message;
  const wire::BitRates rates{.nominal = 500'000};
  const std::int64_t intermission_ns = wire::duration_ns({.nominal = 3}, rates);
  const auto streams = schedulability::streams_of(*database, {}, rates);
  ASSERT_TRUE(streams) << streams.error().message;
  const auto bounds = schedulability::responses(*streams, {.rates = rates});

  scenario::Scenario all = scenario_of("all_four");
  all.duration_us = 4'000'000;
  const Flown run = fly(all, "in-process?bitrate=500000&queue=priority");
  std::size_t judged = 0;
  double nearest = 0;
  for (std::size_t s = 0; s < streams->size(); ++s) {
    const auto info = std::ranges::find(messages::all_messages, (*streams)[s].name, &MessageInfo::name);
    ASSERT_NE(info, messages::all_messages.end());
    const auto index = static_cast<std::size_t>(info - messages::all_messages.begin());
    const checks::Histogram& sent = run.seen.timing.transmit[index].echoed;
    const checks::Histogram& answered = run.seen.timing.answers[index].latency;
    const checks::Histogram& measured = sent.count() > 0 ? sent : answered;
    if (measured.count() == 0) continue;
    ASSERT_TRUE(bounds[s].response_ns) << info->name;
    const std::int64_t response_ns = measured.max_ns() + intermission_ns;
    EXPECT_LE(response_ns, *bounds[s].response_ns) << info->name;
    nearest =
        std::max(nearest, static_cast<double>(response_ns) / static_cast<double>(*bounds[s].response_ns));
    ++judged;
  }
  EXPECT_GE(judged, 50U);
  EXPECT_GT(nearest, 0.8) << "the bounds bind nothing";
}

TEST(InProcessWire, CarriesTheContractOfCanFd) {
  const Flown run = fly(scenario_of("transfer_alignment_quick"),
                        "in-process?bitrate=500000&data-bitrate=2000000", BusFormat::fd);
  EXPECT_EQ(run.verdict.outcome, checks::Outcome::pass) << run.verdict.reason;
  const Flown classic = quick(std::string(at_500k));
  expect_same_estimates(run, classic);
  const std::size_t index = message_index<messages::AlignUpdate>();
  EXPECT_LT(run.seen.timing.answers[index].latency.max_ns(),
            classic.seen.timing.answers[index].latency.min_ns());
}

/// All four estimators on CAN FD; the nodes' queues are FIFO or sorted by priority.
class Containers : public testing::TestWithParam<std::string_view> {};

TEST_P(Containers, KeepTheirBoundsAndTheirTimesAddUp) {
  scenario::Scenario all = scenario_of("all_four");
  all.duration_us = 4'000'000;
  const Flown run =
      fly(all, fmt::format("in-process?bitrate=500000&data-bitrate=2000000{}", GetParam()), BusFormat::fd);
  const checks::TimingRecord& timing = run.seen.timing;
  const auto bounds = checks::wire_bounds(run.seen);
  EXPECT_EQ(bounds.size(), 17U) << "all but the heartbeat";
  double nearest = 0;
  for (const checks::WireBound& bound : bounds) {
    ASSERT_TRUE(bound.bound_ns) << bound.message;
    EXPECT_LE(bound.longest_ns, *bound.bound_ns) << bound.message;
    EXPECT_GT(bound.longest_ns, bound.frame_ns / 2) << bound.message;
    nearest = std::max(nearest, static_cast<double>(bound.longest_ns) / static_cast<double>(*bound.bound_ns));
  }
  EXPECT_GT(nearest, GetParam().empty() ? 0.45 : 0.8) << "the bounds bind nothing";
  // Each group arrived complete, because it was sent in one container.
  EXPECT_EQ(timing.responses[message_index<messages::SlaveImuDeltaTheta>()].count,
            run.seen.stimuli.at("SlaveImu").count);
  EXPECT_EQ(timing.responses[message_index<messages::SeekerAntenna>()].count,
            run.seen.stimuli.at("Seeker").count);
  for (const auto& [group, breakdown] : timing.breakdown_by_group) {
    EXPECT_EQ(breakdown.echoed, breakdown.stimuli) << group;
    EXPECT_GE(breakdown.to_echo_ns, breakdown.stimulus_wire_ns) << group;
    // The duration of each frame is rounded up to whole ns.
    EXPECT_GE(breakdown.latency_ns + static_cast<std::int64_t>(4 * breakdown.stimuli),
              breakdown.reply_wire_ns)
        << group;
  }
}

INSTANTIATE_TEST_SUITE_P(InProcessWire, Containers, testing::Values("", "&queue=priority"));

// The seeker's container is the first after Sync. Nothing else is on the bus except Sync and the heartbeat,
// so the time from the hand-over to the answer is the duration of two containers: stimulus and answer.
TEST(InProcessWire, OnCanFdTheWholeLatencyIsExplained) {
  const Flown run =
      fly(scenario_of("los_quick"), "in-process?bitrate=500000&data-bitrate=2000000", BusFormat::fd);
  const checks::LatencyBreakdown& breakdown = run.seen.timing.breakdown;
  const auto stimuli = static_cast<double>(breakdown.stimuli);
  EXPECT_GT(breakdown.stimuli, 1000U);
  EXPECT_NEAR(static_cast<double>(breakdown.to_echo_ns - breakdown.stimulus_wire_ns) / stimuli, 0, 1'000);
  EXPECT_NEAR(static_cast<double>(breakdown.latency_ns - breakdown.reply_wire_ns) / stimuli, 0, 20'000);
}

TEST(InProcessWire, ADisturbedWireLosesNothingAndTakesLonger) {
  const std::string disturbed = std::string(at_500k) + "&bit-error-rate=1e-4&seed=";
  const Flown clean = quick(std::string(at_500k)), run = quick(disturbed + "1");
  EXPECT_GT(run.seen.bus.errors.bus_error, 10U);
  EXPECT_EQ(run.seen.bus.errors.bus_off, 0U);
  EXPECT_EQ(run.seen.lost_from_target(), 0U);
  EXPECT_EQ(run.seen.counters->frames_lost, 0U);
  expect_same_estimates(run, clean);
  EXPECT_EQ(run.verdict.outcome, checks::Outcome::pass) << run.verdict.reason;
  const std::size_t index = message_index<messages::AlignVelocityD>();
  const checks::Histogram& latency = run.seen.timing.answers[index].latency;
  const checks::Histogram& undisturbed = clean.seen.timing.answers[index].latency;
  EXPECT_EQ(latency.count(), undisturbed.count());
  EXPECT_GT(latency.max_ns(), undisturbed.max_ns() + 50'000);  // error frame of 23 bits, repetition
  EXPECT_EQ(stamps(run), stamps(quick(disturbed + "1")));
  EXPECT_NE(stamps(run), stamps(quick(disturbed + "2")));
}

TEST(InProcessWire, ABusOffReachesTheReportAndTheCheck) {
  scenario::Scenario scenario = scenario_of("transfer_alignment_quick");
  const std::string noisy = std::string(at_500k) + "&bit-error-rate=2e-3";
  const Flown run = fly(scenario, noisy);
  const checks::BusRecord& bus = run.seen.bus;
  EXPECT_GT(bus.errors.bus_off, 0U);
  EXPECT_EQ(bus.errors.bus_off, bus.errors.restarted);
  EXPECT_GT(bus.errors.passive, 0U);
  const auto off = std::ranges::find(bus.incidents, BusEvent::bus_off, &checks::BusIncident::event);
  const auto back = std::ranges::find(bus.incidents, BusEvent::restarted, &checks::BusIncident::event);
  ASSERT_TRUE(off < back && back != bus.incidents.end());
  EXPECT_GE(back->t_ns - off->t_ns, 128 * 11 * 2'000);
  // A bus failure adds this check to a run whose scenario does not contain it.
  ASSERT_NE(find_check(run, "bus_errors"), nullptr);
  EXPECT_EQ(find_check(run, "bus_errors")->outcome, checks::Outcome::fail);

  checks::BusErrorLimits limits;
  limits.bus_off_at_most = 100;
  limits.passive_at_most = static_cast<std::int64_t>(bus.errors.passive) - 1;
  scenario.checks = {checks::check_of(limits, "bus")};
  EXPECT_EQ(fly(scenario, noisy).verdict.outcome, checks::Outcome::fail);
  limits.passive_at_most = static_cast<std::int64_t>(bus.errors.passive);
  scenario.checks = {checks::check_of(limits, "bus")};
  EXPECT_EQ(fly(scenario, noisy).verdict.outcome, checks::Outcome::pass);
}

// The IMU alone sends 300 frames per second, each of at least 111 bits. A bus of 20 kbit/s cannot carry so
// many.
TEST(InProcessWire, ABusThatIsTooSlowMakesTheBenchLate) {
  static const std::atomic<bool> never = false;
  Options options;
  options.bus = BusName("in-process?bitrate=20000");
  const auto run =
      canhil::drive::run(scenario_of("transfer_alignment_quick"), options, never, [](std::int64_t) {});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_NE(run->verdict.outcome, checks::Outcome::pass);
  EXPECT_GT(run->seen.bus.late_in_queue, 0U);
}

// The bus has 1 kbit/s, and every attempt to send fails at its first bit. Heartbeats that become due while
// the device is bus-off are sent as soon as the device returns to the bus, not when the next heartbeat is
// due.
TEST(InProcessWire, ADeviceThatIsOffTheBusWaitsForItsReturn) {
  const WireSettings noisy{.rates = {.nominal = 1'000}, .bit_error_rate = 1};
  InProcessWire port("noisy", noisy, BusFormat::classic);
  std::vector<std::int64_t> at_ns;
  while (port.monotonic_ns() < 5'000'000'000) {
    if (!wait(port, WaitFor::frame, 5'000'000'000)) break;
    while (const auto received = port.receive()) {
      ASSERT_TRUE(received->frame.error);
      at_ns.push_back(received->t_ns);
    }
  }
  ASSERT_GT(at_ns.size(), 64U);
  // Counted from the error flag of the 32nd error: 12 bits of flags, 11 bits of delimiter and intermission,
  // 128 times 11 bits until the return to the bus, and the first bit of the next attempt.
  EXPECT_EQ(at_ns[32] - at_ns[31], (12 + 11 + 128 * 11 + 1) * 1'000'000);
}

TEST(InProcessWire, TimePassesOnlyWhileSomebodyWaits) {
  InProcessWire port("in-process?bitrate=500000", {.rates = {.nominal = 500'000}}, BusFormat::classic);
  EXPECT_EQ(port.monotonic_ns(), 0);
  EXPECT_FALSE(port.receive());
  EXPECT_TRUE(wait(port, WaitFor::frame, 1'000'000'000));  // a heartbeat
  const auto beat = port.receive();
  ASSERT_TRUE(beat);
  EXPECT_EQ(beat->source, StampSource::virtual_time);
  EXPECT_EQ(beat->t_ns, wire::duration_ns(wire::bit_length(beat->frame), {.nominal = 500'000}) - 3 * 2'000L);
  EXPECT_FALSE(wait(port, WaitFor::frame, 50'000'000));
  EXPECT_EQ(port.monotonic_ns(), 50'000'000);
  EXPECT_TRUE(wait(port, WaitFor::frame, 1'000'000'000));  // the next heartbeat
  EXPECT_GE(port.receive()->t_ns, 100'000'000);
  const Frame own{.id = 0x700, .size = 8};
  for (std::size_t i = 0; i < WireNode{}.depth; ++i) ASSERT_EQ(port.send(own), SendOutcome::sent);
  EXPECT_EQ(port.send(own), SendOutcome::queue_full);
  while (port.send(own) != SendOutcome::sent) ASSERT_TRUE(wait(port, WaitFor::room, 1'000'000'000));
  EXPECT_LT(port.monotonic_ns(), 101'000'000);
}

}  // namespace
}  // namespace canhil::drive
