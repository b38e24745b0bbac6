// The page of a report: whole, drawn from the JSON alone, and nothing of it is somebody's markup.
#include "bench/report/page.hpp"

#include <gmock/gmock.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/report/json.hpp"
#include "bench/report/plot.hpp"
#include "bench/report/provenance.hpp"
#include "bench/report/text.hpp"
#include "bench/world/motion/rest.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

scenario::Scenario scenario_of() {
  scenario::Scenario scenario;
  scenario.title = "<script>alert(1)</script>";
  scenario.duration_us = 2'000'000;
  scenario.targets.emplace_back().estimator = "transfer_alignment";
  return scenario;
}

run::Run run_of() {
  run::Run run{
      .verdict = {.outcome = checks::Outcome::fail,
                  .reason = "1 of 2 checks failed",
                  .checks = {{"latency", "latency", "REQ-7", checks::Outcome::fail, "9 ms", "< 5 ms"},
                             {"two", "kind", "", checks::Outcome::not_measured, "late & slow", "x"}}},
      .ending = {},
      .seen = {},
      .truth = {{.start = {}, .motion = world::Rest{}}, 2'000'000, 10'000},
      .options = {},
      .host = realtime::standing(),
      .wall_s = 2};
  run.options.bus = "local:x";
  checks::Observations& seen = run.seen;
  for (std::int64_t t_us = 10'000; t_us <= 2'000'000; t_us += 10'000) {
    seen.navigation.push_back({.cause_us = t_us, .angles = {.roll = 0.001, .pitch = 0, .heading = 0}});
    auto& timing = seen.timing.answers[message_index<messages::AlignVelocityD>()];
    timing.latency.add(200'000 + t_us / 10);
    timing.latency_line.add(t_us * 1000, 200'000);
    timing.jitter.add(5'000);
    seen.timing.lateness.add(30'000);
    seen.timing.lateness_line.add(t_us * 1000, 30'000);
    seen.timing.transmit[message_index<messages::Sync>()].handed_over.add(30'000);
    if (t_us % 100'000 == 0)
      seen.filter.push_back({.cause_us = t_us, .nis = 3, .attitude_sigma = world::Vector3::Constant(0.002)});
  }
  seen.length_by_second.resize(2);
  return run;
}

std::string page_of(const run::Run& run) { return html(document(scenario_of(), run)).value(); }

TEST(Page, NeedsNothingOutsideItself) {
  EXPECT_THAT(page_of(run_of()),
              AllOf(Not(HasSubstr("<script")), Not(HasSubstr("src=")), Not(HasSubstr("url(")),
                    Not(HasSubstr("<link")), Not(HasSubstr("@import"))));
}

// A run at 500 kbit/s: 100 stimuli of 0.3 ms to their echo, 0.2 of it the frame, and 1 ms from there on.
run::Run run_on_a_wire() {
  run::Run run = run_of();
  run.seen.bit_rates = {.nominal = 500'000};
  run.seen.transmit_stamps_echoed = true;
  run.seen.last_ns = 2'000'000'000;
  checks::TimingRecord& timing = run.seen.timing;
  timing.wire.rates = run.seen.bit_rates;
  timing.split = {.stimuli = 100,
                  .echoed = 100,
                  .to_echo_ns = 30'000'000,
                  .stimulus_wire_ns = 20'000'000,
                  .latency_ns = 100'000'000,
                  .reply_wire_ns = 60'000'000,
                  .told = 50,
                  .target_queue_ns = 5'000'000,
                  .target_compute_ns = 10'000'000};
  timing.slowest = {.message = "AlignVelocityD", .t_ns = 1'500'000'000, .latency_ns = 9'000'000};
  timing.slowest.queue_max_us = 8191;
  timing.responses[message_index<messages::Sync>()] = {.count = 200, .max_ns = 250'000};
  timing.responses[message_index<messages::AlignVelocityD>()] = {.count = 100, .max_ns = 9'000'000};
  timing.answers[message_index<messages::AlignVelocityD>()].last_ns = 1;
  return run;
}

TEST(Page, TheLatencyIsSplitAndThePartsAddUp) {
  const auto split = document(scenario_of(), run_on_a_wire()).at("split");
  EXPECT_DOUBLE_EQ(split.at("total_s").get<double>(), 1.3e-3);
  double sum_s = 0;
  for (const auto& [key, mean] : split.at("parts_s").items()) sum_s += mean.get<double>();
  EXPECT_NEAR(sum_s, 1.3e-3, 1e-12);
  EXPECT_NEAR(split.at("parts_s").at("stimulus_wait").get<double>(), 0.1e-3, 1e-12);
  EXPECT_NEAR(split.at("parts_s").at("target_compute").get<double>(), 0.2e-3, 1e-12);
  EXPECT_NEAR(split.at("parts_s").at("not_explained").get<double>(), 0.1e-3, 1e-12);
  const std::string page = page_of(run_on_a_wire());
  EXPECT_THAT(page, HasSubstr("mean of 100 answered stimuli"));
  EXPECT_THAT(
      page,
      HasSubstr("target: computing</td><td data-label=\"ms\">0.200</td><td data-label=\"share\">15.4 %"));
  EXPECT_THAT(
      text(scenario_of(), run_on_a_wire()),
      AllOf(HasSubstr("mean 1.300 ms of 100 stimuli"), HasSubstr("0.600 ms  answer: its frames on the wire"),
            HasSubstr("longest wait was 8191 us or more")));
}

TEST(Page, WhatIsNotKnownOfTheSplitIsNotAZero) {
  run::Run run = run_on_a_wire();
  run.seen.timing.wire.rates = {};
  run.seen.timing.split.told = 0;
  const auto parts = document(scenario_of(), run).at("split").at("parts_s");
  EXPECT_TRUE(parts.at("reply_wire").is_null());
  EXPECT_TRUE(parts.at("target_queue").is_null());
  EXPECT_NEAR(parts.at("not_explained").get<double>(), 1e-3, 1e-12);
  EXPECT_THAT(page_of(run), HasSubstr("<td data-label=\"ms\">not known</td>"));
  EXPECT_THAT(text(scenario_of(), run), Not(HasSubstr("target: computing")));
}

TEST(Page, ShowsEachMessageBesideItsBound) {
  const auto wire = document(scenario_of(), run_on_a_wire()).at("wire");
  ASSERT_EQ(wire.at("messages").size(), 2U);
  EXPECT_EQ(wire.at("messages")[0].at("name"), "Sync");
  EXPECT_DOUBLE_EQ(wire.at("messages")[0].at("longest_s").get<double>(), 250e-6);
  EXPECT_FALSE(wire.at("messages")[0].at("at_least").get<bool>());
  EXPECT_TRUE(wire.at("messages")[1].at("at_least").get<bool>());
  EXPECT_THAT(page_of(run_on_a_wire()), AllOf(HasSubstr("&#10007; beyond"), HasSubstr("&ge; 9.000")));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), HasSubstr("beyond: AlignVelocityD 9.000 ms, bound "));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), HasSubstr("bus load at 500 kbit/s"));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), Not(HasSubstr("bus load at 1000 kbit/s")));
}

TEST(Page, SaysVerdictReasonChecksAndRequirement) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("1 of 2 checks failed"), HasSubstr("REQ-7"), HasSubstr("late &amp; slow"),
                          HasSubstr("&#10007; fail</b>"), HasSubstr("? not measured")));
}

TEST(Page, ShowsLatencyJitterErrorsAndProvenance) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("<h3>AlignVelocityD</h3>"), HasSubstr("Deviation of its period"),
                          HasSubstr("attitude error about north"), HasSubstr("normalised innovation squared"),
                          HasSubstr("velocity error down"), HasSubstr("cpu_model"), HasSubstr("dbc_hash")));
}

TEST(Page, EveryPictureIsWellFormedAndFinite) {
  const std::string page = page_of(run_of());
  int pictures = 0;
  for (auto at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
    const std::string picture = page.substr(at, page.find("</svg>", at) + 6 - at);
    std::istringstream text(picture);
    boost::property_tree::ptree xml;
    EXPECT_NO_THROW(read_xml(text, xml)) << picture;
    EXPECT_THAT(picture, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    ++pictures;
  }
  EXPECT_GE(pictures, 10);
}

TEST(Page, IsTheSameFromTheFileAsFromTheRun) {
  const std::string path = testing::TempDir() + "canhil_page_test.json";
  const run::Run run = run_of();
  std::ofstream(path) << json(scenario_of(), run);
  const auto read = read_document(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(html(*read).value(), page_of(run));
}

TEST(Page, OfVirtualTimeHasNoLatency) {
  run::Run run = run_of();
  run.options.clock = run::ClockKind::lockstep;
  run.timing_unfit = "virtual time";
  EXPECT_THAT(page_of(run),
              AllOf(HasSubstr("Timing is not judged: virtual time."), Not(HasSubstr("Latency of"))));
}

TEST(Page, FilesThatAreNoReportsAreRefusedInOneLine) {
  const std::string path = testing::TempDir() + "canhil_no_report.json";
  EXPECT_THAT(read_document("/no/such").error().message, HasSubstr("/no/such: cannot be read"));
  std::ofstream(path) << "{";
  EXPECT_THAT(read_document(path).error().message, HasSubstr("is no JSON"));
  std::ofstream(path) << "[1]";
  EXPECT_THAT(read_document(path).error().message, HasSubstr("is no report, expected one with \"schema\""));
  const auto torn = html(Json{{"schema", schema}, {"verdict", 5}});
  ASSERT_FALSE(torn);
  EXPECT_THAT(torn.error().message, Not(HasSubstr("\n")));
}

TEST(Page, ASeriesShorterThanItsTimesIsRefused) {
  const Json whole = Json::parse(json(scenario_of(), run_of()));
  for (const char* key : {"t_s", "low", "high", "sigma"}) {
    Json torn = whole;
    torn["series"][0][key].erase(torn["series"][0][key].size() - 1);
    const auto page = html(torn);
    ASSERT_FALSE(page) << key;
    EXPECT_THAT(page.error().message, HasSubstr("as many as t_s"));
  }
}

TEST(Page, ValuesTooDeepWithinOneAnotherAreRefused) {
  const std::string path = testing::TempDir() + "canhil_deep_report.json";
  std::string text = json(scenario_of(), run_of());
  const std::size_t at = text.find("\"timing\": {") + 11;
  std::string deep, end;
  for (int i = 0; i < 100'000; ++i) {
    deep += "{\"a\":";
    end += "}";
  }
  text.insert(at, "\"deep\": " + deep + "1" + end + ",");
  std::ofstream(path) << text;
  const auto read = read_document(path);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("values lie 33 deep within one another"));
}

TEST(JsonReport, CarriesDistributionsWithTheirBuckets) {
  const Json page = document(scenario_of(), run_of());
  const Json& latency = page["latency_s"]["AlignVelocityD"];
  EXPECT_EQ(latency["count"], 200);
  EXPECT_NEAR(latency["p50"].get<double>(), 300e-6, 1e-6);
  EXPECT_NEAR(latency["p999"].get<double>(), 400e-6, 1e-6);
  EXPECT_TRUE(latency["closes_group"]);
  std::uint64_t sum = 0;
  for (const Json& bucket : latency["buckets_us"]) sum += bucket[1].get<std::uint64_t>();
  EXPECT_EQ(sum, 200U);
  EXPECT_EQ(page["jitter_s"]["AlignVelocityD"]["max"], 5e-6);
  EXPECT_EQ(page["transmit_lateness_s"]["Sync"]["handed_over"]["count"], 200);
}

TEST(JsonReport, ErrorsCarryTheSigmaThatTheTargetTold) {
  const Json page = document(scenario_of(), run_of());
  const Json& north = page["series"][0];
  EXPECT_EQ(north["quantity"], "attitude error about north");
  EXPECT_TRUE(north["sigma"].front().is_null()) << "before the first update it told none";
  EXPECT_NEAR(north["sigma"].back().get<double>(), 2, 1e-6);
  EXPECT_NEAR(std::abs(north["high"].back().get<double>()), 1, 1e-3);
}

TEST(RoundValues, AreRoundAndFew) {
  EXPECT_THAT(round_values(0, 10, 5), Pointwise(DoubleNear(1e-9), {0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_THAT(round_values(-0.03, 0.04, 5), Pointwise(DoubleNear(1e-9), {-0.02, 0.0, 0.02, 0.04}));
}

TEST(Plot, AValueThatIsNotThereIsAGap) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string drawn = svg(LinePlot{.title = "x",
                                         .unit = "m",
                                         .t_s = {0, 1, 2, 3},
                                         .low = {1, none, 2, 3},
                                         .high = {1, none, 2, 3},
                                         .limit = {},
                                         .levels = {}});
  EXPECT_THAT(drawn, Not(HasSubstr("nan")));
  EXPECT_THAT(drawn, ContainsRegex("class=\"area\" d=\"M[^Z]*ZM[^Z]*Z\""));
}

TEST(Provenance, FindsTheCpuModel) {
  EXPECT_EQ(cpu_model("processor\t: 0\nmodel\t\t: 106\nmodel name\t: Some CPU @ 2 GHz\nflags: x\n"),
            "Some CPU @ 2 GHz");
  EXPECT_EQ(cpu_model("processor : 0\n"), "unknown");
  EXPECT_EQ(date_utc(0), "unknown");
  EXPECT_EQ(date_utc(86'400), "1970-01-02T00:00:00Z");
}

}  // namespace
}  // namespace canhil::report
