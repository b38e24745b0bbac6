// The content of the sections of a page: timing, results, bus.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/drive/kept_frames.hpp"
#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"
#include "tests/unit/bench/report/finished_run.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string page_of(const drive::Run& run) { return html(document(scenario_of(), run)).value(); }

TEST(PageSections, TheLatencyIsSplitAndThePartsAddUp) {
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
  EXPECT_THAT(page, HasSubstr("a longest wait of 8191 us or more and a longest computing of 0 us"));
  EXPECT_THAT(page, HasSubstr("target: computing</td><td align=\"right\" data-label=\"ms\">0.200</td><td "
                              "align=\"right\" data-label=\"share\">15.4 %"));
  EXPECT_THAT(
      text(scenario_of(), run_on_a_wire()),
      AllOf(HasSubstr("mean 1.300 ms of 100 stimuli"), HasSubstr("0.600 ms  answer: its frames on the wire"),
            HasSubstr("longest wait was 8191 us or more")));
}

TEST(PageSections, WhatIsNotKnownOfTheSplitIsNotAZero) {
  drive::Run run = run_on_a_wire();
  run.seen.timing.wire.rates = {};
  run.seen.timing.breakdown.accounted = 0;
  const auto parts = document(scenario_of(), run).at("split").at("parts_s");
  EXPECT_TRUE(parts.at("reply_wire").is_null());
  EXPECT_TRUE(parts.at("target_queue").is_null());
  EXPECT_NEAR(parts.at("not_explained").get<double>(), 1e-3, 1e-12);
  EXPECT_THAT(page_of(run), HasSubstr("<td align=\"right\" data-label=\"ms\">not known</td>"));
  EXPECT_THAT(text(scenario_of(), run), Not(HasSubstr("target: computing")));
}

TEST(PageSections, APartThatTheTargetCouldNotTellIsMarked) {
  drive::Run run = run_on_a_wire();
  EXPECT_FALSE(document(scenario_of(), run).at("split").contains("at_least"));
  run.seen.timing.breakdown.queue_clipped = true;
  const auto split = document(scenario_of(), run).at("split");
  EXPECT_EQ(split.at("at_least"), Json::array({"target_queue"}));
  EXPECT_EQ(split.at("at_most"), Json::array({"not_explained"}));
  EXPECT_THAT(page_of(run), AllOf(HasSubstr("<td align=\"right\" data-label=\"ms\">&ge; 0.100</td>"),
                                  HasSubstr("reports no times beyond 8191 us")));
  EXPECT_THAT(
      text(scenario_of(), run),
      AllOf(HasSubstr("0.100 ms  target: from its stamp to its turn (at least: the target reports no more)"),
            HasSubstr("wait for the bus (at most)")));
}

// 100 samples of the carrier's rates, 10 ms apart, each with an answer 1 ms later.
std::shared_ptr<const drive::KeptFrames> frames_of_samples_and_answers() {
  auto kept = std::make_shared<drive::KeptFrames>();
  for (int i = 0; i < 100; ++i) {
    kept->transmitted(to_frame(messages::SlaveImuDeltaV{.delta_v_x_mps = 0.01 * i}, 3), i * 10'000'000, 0);
    kept->received({.frame = to_frame(messages::AlignAttitude{.roll_deg = 0.5 * i}, 3),
                    .t_ns = i * 10'000'000 + 1'000'000});
  }
  return kept;
}

TEST(PageSections, TheFramesAroundTheWorstValueStandAtItsCheck) {
  drive::Run run = run_of();
  run.verdict.checks[0].judgement.measurement.worst_at_us = 200'000;
  run.frames = frames_of_samples_and_answers();
  const Json report = document(scenario_of(), run);
  ASSERT_EQ(report["frames"].size(), 1U) << "the other check has no worst value";
  EXPECT_EQ(report["frames"][0]["check"], "latency");
  const Json& frames = report["frames"][0]["frames"];
  ASSERT_EQ(frames.size(), 40U);
  EXPECT_DOUBLE_EQ(frames[0]["t_s"].get<double>(), 0.15);
  EXPECT_DOUBLE_EQ(frames[10]["t_s"].get<double>(), 0.2);
  EXPECT_EQ(frames[10]["message"], "SlaveImuDeltaV");
  EXPECT_EQ(frames[10]["transmitted"], true);
  const Json& answer = frames[11];
  EXPECT_EQ(answer["message"], "AlignAttitude");
  EXPECT_EQ(answer["transmitted"], false);
  EXPECT_EQ(answer["bytes"].get<std::string>().size(), 23U);
  const auto roll = std::ranges::find_if(answer["signals"], [](const Json& s) { return s[0] == "roll_deg"; });
  ASSERT_NE(roll, answer["signals"].end());
  EXPECT_NEAR((*roll)[1].get<double>(), 10, 0.001);
  const std::string page = html(report).value();
  EXPECT_THAT(page, AllOf(HasSubstr("frames around 0.2 s, when its worst value came"),
                          HasSubstr("<b>0.<wbr>200000</b>"), HasSubstr("roll_<wbr>deg ")));
}

TEST(PageSections, AFrameThatTheDbcDoesNotHaveIsShownByItsBytes) {
  drive::Run run = run_of();
  run.verdict.checks[0].judgement.measurement.worst_at_us = 0;
  auto kept = std::make_shared<drive::KeptFrames>();
  kept->transmitted({.id = 0x7FF, .size = 2, .data = {0xAB, 0x01}}, 0, 0);
  run.frames = kept;
  const Json report = document(scenario_of(), run);
  EXPECT_FALSE(report["frames"][0]["frames"][0].contains("message"));
  EXPECT_THAT(html(report).value(), AllOf(HasSubstr("7FF"), HasSubstr("AB 01")));
}

TEST(PageSections, WithoutFramesThePageSaysWhy) {
  drive::Run run = run_of();
  EXPECT_THAT(page_of(run), Not(HasSubstr("are not kept"))) << "no check has a worst value";
  run.verdict.checks[0].judgement.measurement.worst_at_us = 200'000;
  EXPECT_THAT(page_of(run), HasSubstr("are not kept: a run keeps frames only with --html"));
}

TEST(PageSections, FaultsAndChangesStandOnThePage) {
  drive::Run run = run_of();
  EXPECT_THAT(page_of(run), Not(HasSubstr("Faults and changes")));
  run.faults = {{.name = "gyro <1>",
                 .kind = "bias",
                 .count = 401,
                 .windows = {{.from_us = 2'000'000, .to_us = 3'500'000}}},
                {.name = "later", .kind = "noise"}};
  run.seen.bus.notes = {"t=3.900 s: 'spoiler' set imu.rate.z to 2"};
  const std::string page = page_of(run);
  EXPECT_THAT(page, AllOf(HasSubstr("Faults and changes"), HasSubstr(">2 to 3.5<"), HasSubstr(">401<"),
                          HasSubstr("it never began"), HasSubstr("it did not strike"),
                          HasSubstr("'spoiler' set imu")));
  EXPECT_THAT(page, AllOf(HasSubstr("fault 'gyro &lt;1&gt;'"), Not(HasSubstr("fault 'later'"))))
      << "its times are shaded in the plots";
}

TEST(PageSections, TheSplitOfEachGroupStandsBesideThatOfAll) {
  drive::Run run = run_on_a_wire();
  checks::TimingRecord& timing = run.seen.timing;
  timing.breakdown_by_group = {
      {"SlaveImu", {.stimuli = 90, .latency_ns = 45'000'000, .reply_wire_ns = 9'000'000}},
      {"MasterIns", {.stimuli = 10, .latency_ns = 55'000'000, .reply_wire_ns = 1'000'000}}};
  const auto groups = document(scenario_of(), run).at("split").at("groups");
  EXPECT_DOUBLE_EQ(groups.at("SlaveImu").at("total_s").get<double>(), 0.5e-3);
  EXPECT_NEAR(groups.at("MasterIns").at("parts_s").at("target_and_waits").get<double>(), 5.4e-3, 1e-12);
  EXPECT_THAT(page_of(run), AllOf(HasSubstr("MasterIns ms (10)"), HasSubstr("<b>5.500</b>")));
  EXPECT_THAT(text(scenario_of(), run),
              HasSubstr("5.500 ms  in all for MasterIns alone, mean of its 10 stimuli"));
}

TEST(PageSections, ShowsEachMessageBesideItsBound) {
  const auto wire = document(scenario_of(), run_on_a_wire()).at("wire");
  ASSERT_EQ(wire.at("messages").size(), 2U);
  EXPECT_EQ(wire.at("messages")[0].at("name"), "Sync");
  EXPECT_DOUBLE_EQ(wire.at("messages")[0].at("longest_s").get<double>(), 250e-6);
  EXPECT_FALSE(wire.at("messages")[0].at("at_least").get<bool>());
  EXPECT_TRUE(wire.at("messages")[1].at("at_least").get<bool>());
  EXPECT_THAT(page_of(run_on_a_wire()), AllOf(HasSubstr("&#10007; beyond"), HasSubstr("&ge; 9.<wbr>000")));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), HasSubstr("beyond: AlignVelocityD 9.000 ms, bound "));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), HasSubstr("bus load at 500 kbit/s"));
  EXPECT_THAT(text(scenario_of(), run_on_a_wire()), Not(HasSubstr("bus load at 1000 kbit/s")));
}

// The page takes the results of the estimators from the JSON, and shows the same results as the text report.
TEST(PageSections, ShowsTheResultsOfAnAlignment) {
  const std::string page = page_of(run_of());
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>Results</h2>"), HasSubstr("href=\"#results\""),
                          HasSubstr("<h3>transfer_alignment</h3>"), HasSubstr("3 mrad from 0.01 s"),
                          HasSubstr("error at the end</td><td data-label=\"value\">roll +1.000 mrad, pitch"),
                          HasSubstr("answers 200, updates 20</td>")));
}

TEST(PageSections, ShowsTheWordsOfEveryFigureThatHasSome) {
  Json report = document(scenario_of(), run_of());
  report["results"] = Json::parse(
      R"({"wind": {"mean": {"what": "mean <error>", "figures": {"norm": {"value": 1, "words": "of the vector 1 m/s"},
          "none": {"value": 0, "words": ""}, "down": {"value": null, "words": "down none judged"}}}}})");
  EXPECT_THAT(html(report).value(),
              HasSubstr("mean &lt;error&gt;</td><td data-label=\"value\">of the vector 1 m/s, "
                        "down none judged</td>"));
}

// The master INS sends 200 samples, and the target answers none of them. An estimator that is in use should
// answer each sample with AlignUpdate.
TEST(PageSections, AMessageThatWasNeverAnsweredIsThere) {
  drive::Run run = run_of();
  for (int i = 0; i < 200; ++i)
    run.seen.stimuli[messages::MasterInsVelocityD::info.sample_group].add(100'000L * i);
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

TEST(PageSections, TellInVirtualTimeTooWhatWasNeverAnswered) {
  drive::Run run = run_of();
  run.clock = drive::ClockKind::lockstep;
  EXPECT_THAT(text(scenario_of(), run), Not(HasSubstr("latency AlignVelocityD")));
  run.seen.timing.answers[message_index<messages::AlignVelocityD>()] = {};
  EXPECT_THAT(text(scenario_of(), run), ContainsRegex("latency AlignVelocityD +no answers"));
}

TEST(PageSections, TheLoadDoesNotFallInTheSecondInWhichTheRunEnded) {
  drive::Run run = run_of();
  run.seen.length_by_second = {{.nominal = 100'000}, {.nominal = 120'000}, {.nominal = 400}};
  const Json busiest = document(scenario_of(), run).at("bus_load_line").at("busiest");
  ASSERT_EQ(busiest.size(), 2U);
  EXPECT_NEAR(busiest[1].get<double>(), 0.24, 1e-6);
  run.seen.length_by_second.resize(1);
  EXPECT_EQ(document(scenario_of(), run).at("bus_load_line").at("busiest").size(), 1U) << "the only one";
}

}  // namespace
}  // namespace canhil::report
