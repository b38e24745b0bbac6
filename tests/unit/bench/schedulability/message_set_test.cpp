#include "bench/schedulability/message_set.hpp"

#include <gmock/gmock.h>

#include <map>
#include <tuple>

#include "dbc/parser/parse.hpp"

namespace canhil::schedulability {
namespace {

using testing::ElementsAre;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr wire::BitRates rates{.nominal = 500'000, .data = 2'000'000};

dbc::Database database(const std::string& file) {
  auto read = dbc::read_file(file);
  EXPECT_TRUE(read) << read.error().message;
  return read.value_or(dbc::Database{});
}

dbc::Database example() { return database(TEST_DATA_DIR "/dbc/schedulability.dbc"); }

std::map<std::string, Stream> by_name(const dbc::Database& from, const Assumptions& assumptions = {}) {
  std::map<std::string, Stream> streams;
  const auto read = streams_of(from, assumptions, rates);
  for (const Stream& stream : *read) streams[stream.name] = stream;
  return streams;
}

// 0x80010000 is the extended id 0x10000 with base id 0: this id wins every arbitration.
TEST(Streams, AreSortedByPriority) {
  std::vector<std::string> names;
  const auto streams = streams_of(example(), {}, rates);
  for (const Stream& stream : *streams) names.push_back(stream.name);
  EXPECT_THAT(names, ElementsAre("Long", "Brake", "Speed", "Alarm", "Request", "Picture", "Slow"));
}

TEST(Streams, TakeTheirTimesFromTheAttributes) {
  const auto streams = by_name(example());
  const Stream& brake = streams.at("Brake");
  EXPECT_EQ(brake.release, Release::cycle);
  EXPECT_EQ(brake.period_ns, 5 * ms);
  EXPECT_EQ(brake.deadline_ns, 2'500 * us);
  EXPECT_EQ(brake.jitter_ns, 250 * us);
  EXPECT_EQ(brake.sender, "Brake");
  EXPECT_EQ(streams.at("Speed").deadline_ns, 10 * ms);  // the default deadline is the period
  EXPECT_EQ(streams.at("Speed").jitter_ns, 0);
}

TEST(Streams, EventMessagesHaveALeastIntervalOrAreDueOnce) {
  const auto streams = by_name(example());
  EXPECT_EQ(streams.at("Alarm").release, Release::interval);
  EXPECT_EQ(streams.at("Alarm").period_ns, 20 * ms);
  EXPECT_EQ(streams.at("Alarm").deadline_ns, 20 * ms);
  EXPECT_EQ(streams.at("Request").release, Release::once);
  EXPECT_EQ(streams.at("Request").period_ns, 0);
  EXPECT_FALSE(streams.at("Request").deadline_ns);
}

TEST(Streams, AssumptionsFillInWhatTheDbcDoesNotSay) {
  const auto streams = by_name(example(), {.event_interval_ns = 30 * ms, .jitter_ns = 100 * us});
  EXPECT_EQ(streams.at("Request").release, Release::option);
  EXPECT_EQ(streams.at("Request").period_ns, 30 * ms);
  EXPECT_EQ(streams.at("Alarm").period_ns, 20 * ms);
  EXPECT_EQ(streams.at("Speed").jitter_ns, 100 * us);
  EXPECT_EQ(streams.at("Brake").jitter_ns, 250 * us);
}

TEST(Streams, HaveTheLongestFrameOfTheirFormat) {
  const auto streams = by_name(example());
  EXPECT_EQ(streams.at("Brake").length, wire::worst_case_length(2, false));
  EXPECT_EQ(streams.at("Long").length, wire::worst_case_length(8, true));
  EXPECT_EQ(streams.at("Picture").length, wire::worst_case_fd_length(64, false, true));
  EXPECT_EQ(streams.at("Slow").length, wire::worst_case_fd_length(12, false, false));
}

TEST(Streams, FdWithoutItsBitRateIsAnErrorOfOneLine) {
  const auto streams = streams_of(example(), {}, {.nominal = 500'000});
  ASSERT_FALSE(streams);
  EXPECT_EQ(streams.error().message,
            "message Picture is CAN FD and switches the bit rate, expected --data-bitrate or the DBC's "
            "BaudrateCANFD");
}

TEST(Streams, ADbcWithoutMessagesIsAnErrorOfOneLine) {
  const auto streams = streams_of({}, {}, rates);
  ASSERT_FALSE(streams);
  EXPECT_EQ(streams.error().message, "no messages in the DBC, expected at least one");
}

TEST(Streams, ATimeThatIsNoneIsAnError) {
  for (const auto& [attribute, time_ms, shown] : {std::tuple("GenMsgDelayTime", -3.0, "-3"),
                                                  {"GenMsgDeadline", 1e-7, "1e-07"},
                                                  {"GenMsgJitter", 1e18, "1e+18"}}) {
    dbc::Database odd = example();
    odd.messages[0].attributes.insert_or_assign(attribute, time_ms);
    const auto streams = streams_of(odd, {}, rates);
    ASSERT_FALSE(streams) << attribute;
    EXPECT_EQ(streams.error().message, "message " + odd.messages[0].name + " has " + attribute + " " + shown +
                                           " ms, expected 0 (none) or 0.001..1e9");
  }
}

TEST(BitRates, AreTheGivenOnesElseThoseOfTheDbc) {
  const auto own = bit_rates(example(), {});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->nominal, 250'000);
  EXPECT_EQ(own->data, 2'000'000);
  const auto given = bit_rates(example(), {.nominal = 125'000, .data = 1'000'000});
  ASSERT_TRUE(given);
  EXPECT_EQ(given->nominal, 125'000);
  EXPECT_EQ(given->data, 1'000'000);
  EXPECT_EQ(bit_rates({}, {}).error().message,
            "no bit rate, expected --bitrate or the DBC's attribute Baudrate");
}

// canhil.dbc claims a bus load below 50 % at 1 Mbit/s with all nodes active.
TEST(Contract, IsSchedulableWithEveryNodeOn) {
  for (const auto& [rate, most] : {std::pair{1'000'000, 0.5}, {500'000, 1.0}}) {
    const Bus bus{.rates = {.nominal = rate}};
    const auto streams = streams_of(database(SOURCE_DIR "/dbc/canhil.dbc"), {}, bus.rates).value();
    EXPECT_LT(utilisation(streams, bus.rates), most);
    const auto r = responses(streams, bus);
    for (std::size_t i = 0; i < r.size(); ++i)
      EXPECT_TRUE(meets_deadline(streams[i], r[i])) << streams[i].name;
  }
}

}  // namespace
}  // namespace canhil::schedulability
