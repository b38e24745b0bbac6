#include "bench/schedulability/report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace canhil::schedulability {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t ms = 1'000'000;

/// Two messages of 1 ms each at 100 kbit/s; the second one can miss the given deadline.
Analysis two(std::int64_t deadline_ns, Release release = Release::cycle) {
  std::vector<Stream> streams{{.name = "High",
                               .id = 0x10,
                               .sender = "A",
                               .period_ns = 10 * ms,
                               .deadline_ns = 10 * ms,
                               .length = {.nominal = 100}},
                              {.name = "Low",
                               .id = 0x1234567,
                               .extended = true,
                               .sender = "B",
                               .release = release,
                               .period_ns = 20 * ms,
                               .deadline_ns = deadline_ns,
                               .length = {.nominal = 100}}};
  if (release == Release::once) {
    streams[1].period_ns = 0;
    streams[1].deadline_ns.reset();
  }
  return analyse("x.dbc", std::move(streams), {.rates = {.nominal = 100'000}});
}

TEST(Table, NamesEveryMessageAndTheVerdict) {
  const std::string text = table(two(5 * ms));
  EXPECT_THAT(
      text,
      HasSubstr("High                            010 A          cycle       10.000    10.000   100   1.000"
                "   1.000     2.000     8.000\n"));
  EXPECT_THAT(
      text,
      HasSubstr("Low                        01234567 B          cycle       20.000     5.000   100   1.000"
                "   0.000     2.000     3.000\n"));
  EXPECT_THAT(text, HasSubstr("utilisation 15.00 % of 100000 bit/s\n"));
  EXPECT_THAT(text, HasSubstr("\nschedulable: 2 messages\n"));
  EXPECT_TRUE(schedulable(two(5 * ms)));
}

TEST(Table, NamesWhatMissesItsDeadline) {
  const std::string text = table(two(2 * ms - 1));
  EXPECT_THAT(text, HasSubstr("MISSED\n"));
  EXPECT_THAT(text, HasSubstr("\nNOT schedulable: 1 of 2 messages: Low\n"));
  EXPECT_FALSE(schedulable(two(2 * ms - 1)));
}

TEST(Table, OfManyThatMissTheirDeadlinesNamesAFew) {
  Analysis many = two(2 * ms - 1);
  std::vector<Stream> streams;
  for (unsigned i = 0; i < 7; ++i) {
    streams.push_back(many.streams[1]);
    streams.back().name = "Low" + std::to_string(i);
    streams.back().id = 100 + i;
  }
  many = analyse("x.dbc", streams, many.bus);
  EXPECT_THAT(table(many), testing::ContainsRegex(
                               "NOT schedulable: 7 of 7 messages: (Low[0-6], ){4}Low[0-6] and 2 more\n"));
}

TEST(Table, WithoutABoundSaysWhetherTheBusIsOverloaded) {
  Analysis none = two(5 * ms);
  EXPECT_THAT(table(none), Not(HasSubstr("R none")));
  none.responses[0].response_ns.reset();
  EXPECT_THAT(table(none),
              HasSubstr("R none: the analysis finds no bound; the bus itself is not overloaded\n"));
  none.streams[0].period_ns = 1;
  EXPECT_THAT(table(none), HasSubstr("R none: no bound, the bus is overloaded\n"));
}

TEST(Table, SaysWhatIsTakenForGrantedOfEventMessages) {
  EXPECT_THAT(table(two(5 * ms)), Not(HasSubstr("\nrelease ")));
  EXPECT_THAT(table(two(5 * ms, Release::once)),
              HasSubstr("\nrelease once: an event message without GenMsgDelayTime"));
  EXPECT_THAT(table(two(5 * ms, Release::option)), HasSubstr("\nrelease option: "));
  EXPECT_THAT(table(two(5 * ms, Release::interval)), HasSubstr("\nrelease interval: "));
}

TEST(Table, NamesTheErrorModel) {
  Analysis analysis = two(5 * ms);
  analysis.bus.errors = {.burst = 2, .interval_ns = 100 * ms};
  EXPECT_THAT(table(analysis), HasSubstr("bus errors: 2 at once, and one more every 100.000 ms\n"));
}

TEST(Table, SaysWhereThereIsNoBound) {
  Analysis overloaded = two(5 * ms);
  overloaded.streams[0].period_ns = 1 * ms;
  overloaded = analyse("x.dbc", overloaded.streams, overloaded.bus);
  EXPECT_THAT(table(overloaded), HasSubstr("none"));
  EXPECT_THAT(table(overloaded), HasSubstr("NOT schedulable: 2 of 2 messages: High, Low\n"));
  EXPECT_TRUE(nlohmann::json::parse(json(overloaded))["messages"][1]["response_s"].is_null());
}

TEST(Json, HoldsTheSame) {
  const auto root = nlohmann::json::parse(json(two(5 * ms)));
  EXPECT_EQ(root["file"], "x.dbc");
  EXPECT_EQ(root["bitrate_bps"], 100'000);
  EXPECT_TRUE(root["data_bitrate_bps"].is_null());
  EXPECT_TRUE(root["error_interval_s"].is_null());
  EXPECT_NEAR(root["utilisation"].get<double>(), 0.15, 1e-12);
  EXPECT_EQ(root["schedulable"], true);
  const auto& low = root["messages"][1];
  EXPECT_EQ(low["name"], "Low");
  EXPECT_EQ(low["id"], 0x1234567);
  EXPECT_EQ(low["extended"], true);
  EXPECT_EQ(low["release"], "cycle");
  EXPECT_DOUBLE_EQ(low["deadline_s"].get<double>(), 0.005);
  EXPECT_DOUBLE_EQ(low["transmission_s"].get<double>(), 0.001);
  EXPECT_DOUBLE_EQ(low["blocking_s"].get<double>(), 0);
  EXPECT_DOUBLE_EQ(low["response_s"].get<double>(), 0.002);
  EXPECT_DOUBLE_EQ(low["slack_s"].get<double>(), 0.003);
  EXPECT_EQ(low["meets_deadline"], true);
}

TEST(Json, NamesAFileThatIsNotUtf8) {
  Analysis analysis = two(5 * ms);
  analysis.file = "c\xFF.dbc";
  EXPECT_EQ(nlohmann::json::parse(json(analysis))["file"], "c\uFFFD.dbc");
}

}  // namespace
}  // namespace canhil::schedulability
