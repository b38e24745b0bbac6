#include "bench/schedulability/analysis.hpp"

#include <gmock/gmock.h>

#include <array>

namespace canhil::schedulability {
namespace {

using testing::ElementsAre;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;

Stream stream(std::string name, std::int64_t bits, std::int64_t period_ns,
              std::optional<std::int64_t> deadline_ns) {
  return {.name = std::move(name),
          .period_ns = period_ns,
          .deadline_ns = deadline_ns,
          .length = {.nominal = bits}};
}

std::vector<std::int64_t> bounds_us(std::span<const Stream> streams, const Bus& bus) {
  std::vector<std::int64_t> result;
  for (const Response& r : responses(streams, bus)) result.push_back(r.response_ns.value_or(-us) / us);
  return result;
}

// Davis et al. 2007, table 3: three messages of 125 bits (7 bytes) at 125 kbit/s.
constexpr Bus bus_125k{.rates = {.nominal = 125'000}};
const std::vector<Stream> refuted{stream("A", 125, 2'500 * us, 2'500 * us),
                                  stream("B", 125, 3'500 * us, 3'250 * us),
                                  stream("C", 125, 3'500 * us, 3'250 * us)};

// The analysis of 1994 considers only the first instance of message C. This instance has a response time of
// 3 ms, which is within the deadline. The second instance, due at 3.5 ms, has a response time of 3.5 ms,
// because B and C delay each other.
TEST(Davis2007, TheSecondInstanceOfCMissesItsDeadline) {
  const auto r = responses(refuted, bus_125k);
  EXPECT_THAT(bounds_us(refuted, bus_125k), ElementsAre(2'000, 3'000, 3'500));
  EXPECT_EQ(r[2].instances, 2);
  EXPECT_EQ(r[2].worst_instance, 1);
  EXPECT_TRUE(meets_deadline(refuted[1], r[1]));
  EXPECT_FALSE(meets_deadline(refuted[2], r[2]));
  EXPECT_NEAR(utilisation(refuted, bus_125k.rates), 0.971, 0.001);
}

/// The SAE benchmark (class C application requirements, SAE J2056/1) as 17 messages at 125 kbit/s: bytes
/// and period [ms], by priority.
std::vector<Stream> sae_benchmark() {
  struct Row {
    unsigned bytes;
    std::int64_t period_ms;
  };
  constexpr std::array<Row, 17> rows{{{1, 50},
                                      {2, 5},
                                      {1, 5},
                                      {2, 5},
                                      {1, 5},
                                      {2, 5},
                                      {6, 10},
                                      {1, 10},
                                      {2, 10},
                                      {3, 10},
                                      {1, 50},
                                      {4, 100},
                                      {1, 100},
                                      {1, 100},
                                      {3, 1000},
                                      {1, 1000},
                                      {1, 1000}}};
  std::vector<Stream> streams;
  for (const Row& row : rows) {
    Stream& added = streams.emplace_back(stream("", 0, row.period_ms * ms, row.period_ms * ms));
    added.length = wire::worst_case_length(row.bytes, false);
  }
  return streams;
}

// Here every message has one instance in its busy period, so the analysis of 1994 gives the same response
// times. A separate program computed the expected times with the recurrence of 1994.
TEST(SaeBenchmark, At125KilobitsPerSecond) {
  EXPECT_THAT(bounds_us(sae_benchmark(), bus_125k),
              ElementsAre(1'440, 2'040, 2'560, 3'160, 3'680, 4'280, 5'040, 8'400, 9'000, 9'680, 10'200,
                          19'280, 19'800, 20'320, 29'240, 29'760, 29'760));
}

// Tindell, Burns, Wellings 1995: at 125 kbit/s the benchmark meets all deadlines of the control loops. At
// half of that bit rate the bus is overloaded, and the messages of the lowest priority have no bound.
TEST(SaeBenchmark, AtHalfTheBitRateTheBusIsOverloaded) {
  const Bus bus{.rates = {.nominal = 62'500}};
  EXPECT_GT(utilisation(sae_benchmark(), bus.rates), 1);
  const auto r = responses(sae_benchmark(), bus);
  EXPECT_TRUE(r.front().response_ns);
  EXPECT_FALSE(r.back().response_ns);
  EXPECT_FALSE(meets_deadline(sae_benchmark().back(), r.back()));
}

TEST(Responses, QueueingJitterOfTheOthersIsInterferenceOwnJitterIsAdded) {
  std::vector<Stream> streams{stream("high", 100, 10 * ms, 10 * ms), stream("low", 100, 20 * ms, 20 * ms)};
  const Bus bus{.rates = {.nominal = 100'000}};  // C = 1 ms
  EXPECT_THAT(bounds_us(streams, bus), ElementsAre(2'000, 2'000));
  streams[0].jitter_ns = 9'990 * us;  // two instances of `high` can be 10 us apart
  EXPECT_THAT(bounds_us(streams, bus), ElementsAre(2'000 + 9'990, 3'000));
  streams[1].jitter_ns = 500 * us;
  EXPECT_THAT(bounds_us(streams, bus), ElementsAre(2'000 + 9'990, 3'500));
}

// A frame that becomes due during the first bit of another frame still takes part in the arbitration. In the
// second case, `low` begins after a queueing delay of 9.995 ms. `high` becomes due again at 10 ms, half a bit
// after the start of `low`, and still wins.
TEST(Responses, TheFirstBitIsStillOpenToHigherPriority) {
  const std::vector<Stream> streams{stream("high", 100, 10 * ms, 10 * ms),
                                    stream("low", 100, 100 * ms, 100 * ms)};
  const Bus bus{.rates = {.nominal = 100'000}};
  EXPECT_EQ(response(streams, 1, 8'990 * us, bus).response_ns, 10'990 * us);
  EXPECT_EQ(response(streams, 1, 8'995 * us, bus).response_ns, 11'995 * us);
}

TEST(Responses, ErrorsCostAnErrorFrameAndTheLongestRetransmission) {
  const std::vector<Stream> streams{stream("long", 130, 100 * ms, {}), stream("short", 60, 100 * ms, {})};
  const auto with = [&streams](ErrorModel errors) {
    return bounds_us(streams, {.rates = {.nominal = 1'000'000}, .errors = errors});
  };
  EXPECT_THAT(with({}), ElementsAre(190, 190));
  EXPECT_THAT(with({.burst = 1, .interval_ns = 10 * ms}), ElementsAre(190 + 161, 190 + 161));
  EXPECT_THAT(with({.burst = 3, .interval_ns = 10 * ms}), ElementsAre(190 + 3 * 161, 190 + 3 * 161));
  // With one more error every 200 us, the number of errors within t us is ceil(t / 200). Here t is 995 us.
  EXPECT_THAT(with({.burst = 1, .interval_ns = 200 * us}), ElementsAre(190 + 5 * 161, 190 + 5 * 161));
  // With an error every 100 us, the bus cannot recover.
  EXPECT_THAT(with({.burst = 1, .interval_ns = 100 * us}), ElementsAre(-1, -1));
}

TEST(Responses, AnEventOfUnknownIntervalIsDueOnce) {
  std::vector<Stream> streams{stream("event", 100, 0, {}), stream("cyclic", 100, 2'500 * us, 2'500 * us)};
  streams[0].deadline_ns.reset();
  const Bus bus{.rates = {.nominal = 100'000}};
  EXPECT_THAT(bounds_us(streams, bus), ElementsAre(2'000, 2'000));
  EXPECT_DOUBLE_EQ(utilisation(streams, bus.rates), 0.4);
}

}  // namespace
}  // namespace canhil::schedulability
