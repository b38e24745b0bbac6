// The page of a report: whole, drawn from the JSON alone, and nothing of it is somebody's markup.
#include "bench/report/page.hpp"

#include <gmock/gmock.h>

#include <algorithm>
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
using testing::ElementsAre;
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
  EXPECT_THAT(read_document("/no/such").error().message, HasSubstr("'/no/such': cannot be read"));
  std::ofstream(path) << "{";
  EXPECT_THAT(read_document(path).error().message, HasSubstr("is no JSON"));
  std::ofstream(path) << "[1]";
  EXPECT_THAT(read_document(path).error().message, HasSubstr("is no report, expected one with \"schema\""));
  const auto torn = html(Json{{"schema", schema}, {"verdict", 5}});
  ASSERT_FALSE(torn);
  EXPECT_THAT(torn.error().message, Not(HasSubstr("\n")));
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
  const auto found = std::ranges::find_if(
      page["series"], [](const Json& s) { return s["quantity"] == "attitude error about north"; });
  ASSERT_NE(found, page["series"].end());
  const Json& north = *found;
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
  const std::string drawn = svg(LinePlot{
      .title = "x", .unit = "m", .t_s = {0, 1, 2, 3}, .low = {1, none, 2, 3}, .high = {1, none, 2, 3}});
  EXPECT_THAT(drawn, Not(HasSubstr("nan")));
  EXPECT_THAT(drawn, ContainsRegex("class=\"area\" d=\"M[^Z]*ZM[^Z]*Z\""));
}

TEST(Plot, MarksOfAnAxisCanBeToldApart) {
  EXPECT_THAT(mark_labels({-89.9905, -89.99, -89.9895}), ElementsAre("-89.9905", "-89.9900", "-89.9895"));
  EXPECT_THAT(mark_labels({0, 0.5, 1}), ElementsAre("0", "0.5", "1.0"));
  EXPECT_THAT(mark_labels({0, 20, 40}), ElementsAre("0", "20", "40"));
  EXPECT_THAT(mark_labels({2e6, 2.1e6}), ElementsAre("2.0e+06", "2.1e+06"));
  EXPECT_THAT(mark_labels({0}), ElementsAre("0"));
}

TEST(Plot, ABarThatWouldHideTheCurveIsLeftOut) {
  LinePlot plot{.title = "x", .unit = "m", .t_s = {0, 1}, .low = {1, 1}, .high = {1, 1}};
  plot.bars = {{.below = 2, .from_s = 0, .to_s = 1}};
  EXPECT_THAT(svg(plot), HasSubstr("class=\"bar\""));
  plot.bars[0].below = 200;
  EXPECT_THAT(svg(plot), Not(HasSubstr("class=\"bar\"")));
}

// What the text tells of the estimators stands on the page too, drawn from the JSON.
TEST(Page, ShowsTheResultsOfAnAlignment) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>Results</h2>"), HasSubstr("href=\"#results\""),
                          HasSubstr("3 mrad</td><td data-label=\"from\">0.01 s"),
                          HasSubstr("roll error at the end</td><td data-label=\"value\">+1.000 mrad"),
                          HasSubstr("velocity error at the end")));
}

TEST(Page, ShowsTheResultsOfAnEngagementAndAWind) {
  Json report = document(scenario_of(), run_of());
  report.erase("alignments");
  report["engagement"] = Json::parse(
      R"({"miss_m": 0.25, "passage_s": 5.5, "late_commands": 3, "outcomes": {"updated": 7},
          "los_rate_rms": [{"most_to_go_s": 3, "least_to_go_s": 2, "rms_radps": 0.00164},
                           {"most_to_go_s": 2, "least_to_go_s": 1, "rms_radps": null}]})");
  report["wind"] = Json::parse(
      R"({"from_s": 10, "along_track_sigma_mps": 1.5, "outcomes": {"updated": 9},
          "mean_error_mps": {"norm": 2.7, "along_track": 2.5, "cross_track": null, "down": 0.5}})");
  EXPECT_THAT(
      html(report).value(),
      AllOf(HasSubstr("0.250 m at 5.500 s"), HasSubstr("3 to 2 s"), HasSubstr("1.64 mrad/s"),
            HasSubstr("no answers</td>"), HasSubstr("answers too late to guide</td>"),
            HasSubstr("of the vector</td><td data-label=\"value\">2.700 m/s"),
            HasSubstr("across track</td><td data-label=\"value\">none judged"), HasSubstr("1.500 m/s")));
}

// 200 stimuli, and of the answers of a group of an estimator in use not one.
TEST(Page, AMessageThatWasNeverAnsweredIsThere) {
  run::Run run = run_of();
  for (int i = 0; i < 200; ++i)
    run.seen.stimuli[messages::MasterInsVelocityD::info.sample_group].add(100'000 * i);
  const Json latencies = document(scenario_of(), run).at("latency_s");
  ASSERT_TRUE(latencies.contains("AlignUpdate"));
  EXPECT_EQ(latencies["AlignUpdate"]["count"], 0);
  EXPECT_EQ(latencies["AlignUpdate"]["unanswered"], 200);
  EXPECT_TRUE(latencies["AlignUpdate"]["closes_group"]);
  EXPECT_FALSE(latencies.contains("FixUpdate")) << "nobody asked for it";
  EXPECT_THAT(page_of(run), AllOf(HasSubstr("<h3>AlignUpdate</h3>"), HasSubstr("No answers: 200 never came."),
                                  HasSubstr("answers that never came: AlignUpdate")));
  EXPECT_THAT(text(scenario_of(), run),
              HasSubstr("latency AlignUpdate           no answers, 200 never came\n"));
}

TEST(Page, TheLoadDoesNotFallInTheSecondInWhichTheRunEnded) {
  run::Run run = run_of();
  run.seen.length_by_second = {{.nominal = 100'000}, {.nominal = 120'000}, {.nominal = 400}};
  const Json busiest = document(scenario_of(), run).at("bus_load_line").at("busiest");
  ASSERT_EQ(busiest.size(), 2U);
  EXPECT_NEAR(busiest[1].get<double>(), 0.24, 1e-6);
  run.seen.length_by_second.resize(1);
  EXPECT_EQ(document(scenario_of(), run).at("bus_load_line").at("busiest").size(), 1U) << "the only one";
}

TEST(Provenance, SaysWhatWasTested) {
  run::Run run = run_of();
  const auto target = [&] { return document(scenario_of(), run).at("provenance").at("target"); };
  EXPECT_EQ(target().at("program"), "runs elsewhere");
  run.options.target = "./hil-target";
  run.target_file = {.hash = 0xAB, .bytes = 1234, .modified_s = 86'400};
  EXPECT_EQ(target().dump(), R"({"program":"./hil-target","file_hash":"00000000000000ab","file_bytes":1234,)"
                             R"("file_date":"1970-01-02T00:00:00Z"})");
  EXPECT_THAT(page_of(run), HasSubstr("target: file_hash"));
  run.options.bus = "in-process";
  EXPECT_EQ(target().dump(), R"({"program":"in hil-bench itself"})");
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
