// Tests what a user sees of a run: verdict, exit code, reports.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fstream>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Run, ThePapersFlightPassesInRealTime) {
  const std::string report = scratch("report.json");
  const Ended ended = hil_bench_whole(
      fmt::format("run {} --bus {} --json {}", scenario("transfer_alignment"), bus(), report), report);
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, read_json(report));
  EXPECT_EQ(figure(read_json(report), "transfer_alignment", "answers", "answers"), 2000);
  EXPECT_EQ(figure(read_json(report), "transfer_alignment", "answers", "updates"), 200);
  EXPECT_EQ(ended.err, "") << "no progress line into a pipe";
}

class RunOfScenario : public testing::TestWithParam<const char*> {};

TEST_P(RunOfScenario, OutputsPassInLockstep) {
  const std::string report = scratch(std::string(GetParam()) + ".json");
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --lockstep --json {}", scenario(GetParam()), bus(), report));
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, read_json(report));
}

INSTANTIATE_TEST_SUITE_P(Run, RunOfScenario,
                         testing::Values("inflight_ssbl", "inflight_ssbl_180", "inflight_gps", "los_quick",
                                         "los_closed_loop", "los_closed_loop_500hz", "wind_ekf",
                                         "wind_h_infinity"));

TEST(Run, AMissileIsGuidedByTheTargetInRealTime) {
  const std::string report = scratch("los.json");
  const Ended ended = hil_bench_whole(
      fmt::format("run {} --bus {} --json {}", scenario("los_closed_loop"), bus(), report), report);
  ASSERT_NE(ended.code, 2) << ended.err;
  expect_outputs_passed(ended, read_json(report));
  EXPECT_LT(figure(read_json(report), "los_rate", "end", "miss"), 2.0);
  EXPECT_GT(figure(read_json(report), "los_rate", "answers", "answers"), 1000);
  EXPECT_THAT(ended.out, HasSubstr("RMS [mrad/s] by s to go"));
}

TEST(Run, ATargetKilledInMidRunIsNamed) {
  const std::string mortal = scratch("mortal_target");
  std::ofstream(mortal) << "#!/bin/sh\nexec timeout -s KILL 1 " HIL_TARGET " \"$@\"\n";
  ASSERT_EQ(shell("chmod +x " + mortal).code, 0);
  const std::string report = scratch("killed.json");
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --target {} --json {}",
                                            scenario("transfer_alignment"), bus(), mortal, report));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("fail: target: ended by SIGKILL (Killed) at t="));
  // The run ends when the bench detects this, not after 20 s.
  EXPECT_LT(read_json(report)["wall_s"].get<double>(), 15.0);
  EXPECT_LT(read_json(report)["ending"]["t_s"].get<double>(), 15.0);
}

TEST(Run, ATargetThatIsNotThereIsAConfigurationErrorNotAHang) {
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --target none", scenario("transfer_alignment_quick"),
                            bus() == "local:" ? "local:nobody" : bus()));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("no answer within 5 s while waiting for its heartbeat"));
}

TEST(Run, ATargetThatExitsAtOnceIsNamedWithItsExitCode) {
  const Ended ended = hil_bench(
      fmt::format("run {} --bus {} --target /bin/false", scenario("transfer_alignment_quick"), bus()));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("target: exited with 1 while waiting for its heartbeat"));
}

TEST(Run, ACheckThatCannotHoldFailsTheRun) {
  std::string text = read(scenario("transfer_alignment_quick"));
  text +=
      "\n[[check]]\nname = \"impossible\"\nkind = \"error\"\nquantity = \"attitude.heading\"\nfrom_s = "
      "1.0\nbelow_mrad = "
      "1e-6\nrequirement = \"R<1>\"\n";
  std::ofstream(scratch("impossible.toml")) << text;
  const std::string junit = scratch("report.xml");
  const Ended ended = hil_bench(
      fmt::format("run {} --bus {} --lockstep --junit {}", scratch("impossible.toml"), bus(), junit));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("FAIL"));

  boost::property_tree::ptree xml;
  read_xml(junit, xml);
  const auto& suite = xml.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 1);
  EXPECT_EQ(suite.get<std::size_t>("<xmlattr>.tests"), suite.count("testcase"));
  EXPECT_THAT(read(junit), HasSubstr("value=\"R&lt;1&gt;\""));
}

// In virtual time, the times on the simulated wire are exact: they do not depend on the host, and all runs
// are equal.
TEST(SimulatedWire, TheReportSaysWhoseTimesTheseAre) {
  const std::string report = scratch("wire.json");
  const std::string run = fmt::format("run {} --bus 'in-process?bitrate=500000&bit-error-rate=1e-4' --json ",
                                      scenario("transfer_alignment_quick"));
  const Ended first = hil_bench(run + report);
  EXPECT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr(" · virtual, simulated wire · "));
  EXPECT_THAT(first.out, HasSubstr("latency by the simulated wire's stamps in virtual time"));
  const nlohmann::json page = read_json(report);
  EXPECT_EQ(page["provenance"]["clock"], "virtual, simulated wire");
  EXPECT_EQ(page["timing"]["judged"], true);
  EXPECT_GT(page["timing"]["answer_stamps"]["virtual_time"], 500);
  EXPECT_GT(page["bus"]["error_frames"], 10);
  const std::string again = scratch("again.json");
  ASSERT_EQ(hil_bench(run + again).code, 0);
  const nlohmann::json second = read_json(again);
  EXPECT_EQ(page["latency_s"], second["latency_s"]);
  EXPECT_EQ(page["jitter_s"], second["jitter_s"]);
  const Ended compared = hil_bench("compare " + report + " " + again);
  EXPECT_EQ(compared.code, 0) << compared.out;
}

// Runs the scenario with the additional check wire_response. `options` select the bus: classic CAN or CAN FD.
nlohmann::json with_bounds(const std::string& options) {
  std::ofstream(scratch("bounds.toml"))
      << read(scenario("los_quick")) << "\n[[check]]\nkind = \"wire_response\"\n";
  const std::string report = scratch("bounds.json");
  const Ended ended = hil_bench(fmt::format("run {} {} --json {}", scratch("bounds.toml"), options, report));
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  nlohmann::json page = read_json(report);
  for (const auto& message : page["wire"]["messages"]) {
    EXPECT_LE(message["longest_s"].get<double>(), message["bound_s"].get<double>()) << message;
    EXPECT_LE(message["frame_s"].get<double>(), message["bound_s"].get<double>()) << message;
  }
  EXPECT_NEAR(page["split"]["parts_s"]["not_explained"].get<double>(), 0, 20e-6)
      << "what Sync and heartbeats take";
  return page;
}

/// The path of a copy of the scenario with an output interval of 60 ms and a check of the period of
/// `message`.
std::string with_interval(const std::string& name, const std::string& message, int within_percent) {
  constexpr std::string_view table = "[target.parameters]\n";
  std::string text = read(scenario(name));
  text.insert(text.find(table) + table.size(), "output_interval_ms = 60\n");
  std::string path = scratch("interval.toml");
  std::ofstream(path)
      << text
      << fmt::format(
             "\n[[check]]\nname = \"own interval\"\nkind = \"output_period\"\nmessage = \"{}\"\n"
             "within_percent = {}\n",
             message, within_percent);
  return path;
}

// The check expects the period that the scenario sets with output_interval_ms, not the cycle time in the DBC.
TEST(SimulatedWire, ThePeriodOfAnswersIsTheIntervalThatTheScenarioSets) {
  for (const auto& [name, message] :
       {std::pair("transfer_alignment_quick", "AlignAttitude"), std::pair("inflight_ssbl", "FixVelocityD"),
        std::pair("wind_quick", "WindUpdate")}) {
    std::string file = with_interval(name, message, 2);
    if (name == std::string("inflight_ssbl")) {  // this scenario sets an interval itself
      std::string text = read(file);
      text.erase(text.find("output_interval_ms = 20\n"), 24);
      std::ofstream(file) << text;
    }
    const std::string out = hil_bench(fmt::format("run {} --bus 'in-process?bitrate=1000000'", file)).out;
    EXPECT_THAT(out, ContainsRegex(fmt::format("PASS +own interval .*{} every 60 ms", message))) << name;
  }
}

TEST(SimulatedWire, EveryMessageKeepsItsBoundAndTheWholeLatencyIsExplained) {
  nlohmann::json page = with_bounds("--bus 'in-process?bitrate=500000'");
  EXPECT_GE(page["wire"]["messages"].size(), 8U);
  EXPECT_FALSE(page["wire"].contains("data_bitrate_bitps"));
  EXPECT_GT(page["split"]["parts_s"]["reply_wire"].get<double>(), 3 * 150e-6);

  const Ended without = hil_bench(fmt::format("run {} --bus in-process", scratch("bounds.toml")));
  EXPECT_EQ(without.code, 3) << without.out;
  EXPECT_THAT(without.out, HasSubstr("the bit rate of this bus is not known"));
}

TEST(SimulatedWire, OnCanFdEveryContainerKeepsItsBoundAndTheWholeLatencyIsExplained) {
  nlohmann::json page = with_bounds("--dbc canhil-fd --bus 'in-process?bitrate=500000&data-bitrate=2000000'");
  EXPECT_EQ(page["wire"]["data_bitrate_bitps"], 2'000'000);
  std::vector<std::string> names;
  for (const auto& message : page["wire"]["messages"]) names.push_back(message["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"Seeker", "LosRate", "Sync"}));
  EXPECT_GT(page["split"]["parts_s"]["stimulus_wire"].get<double>(), 150e-6);
  EXPECT_GT(page["split"]["parts_s"]["reply_wire"].get<double>(), 150e-6);
  const Ended drawn = hil_bench("report " + scratch("bounds.json"));
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_THAT(read(scratch("bounds.html")), HasSubstr("Over the bus at 500 and 2000 kbit/s"));
}

// A run in real time, in which the target reports its own times. The test does not check how long these times
// are, because this depends on the host.
TEST(SimulatedWire, OnCanFdARunInRealTimeHasBoundsAndAWholeSplit) {
  const std::string report = scratch("fd.json");
  const Ended ended = hil_bench(
      fmt::format("run {} --dbc canhil-fd --bus 'local:?bitrate=500000&data-bitrate=2000000' --json {}",
                  scenario("transfer_alignment_quick"), report));
  EXPECT_NE(ended.code, 2) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("bounds for 6 of 6 messages"));
  const nlohmann::json page = read_json(report);
  EXPECT_EQ(page["wire"]["no_bounds"], "");
  double sum_s = 0;
  for (const auto& [part, mean] : page["split"]["parts_s"].items()) {
    ASSERT_TRUE(mean.is_number()) << part;
    // The part not_explained may be negative, because bench and target average over different stimuli.
    const bool is_rest = part == "not_explained";
    EXPECT_TRUE(is_rest || mean.get<double>() >= 0) << part;
    sum_s += mean.get<double>();
  }
  EXPECT_NEAR(sum_s, page["split"]["total_s"].get<double>(), 1e-9);
}

TEST(Schedulability, SaysByItsExitCodeWhetherTheBusCanCarryTheContract) {
  const std::string contract = SOURCE_DIR "/dbc/canhil.dbc";
  const Ended enough = hil_bench("schedulability --bitrate 1000000 --json " + contract);
  EXPECT_EQ(enough.code, 0) << enough.err;
  EXPECT_EQ(json_of(enough.out)["schedulable"], true);
  const Ended overloaded = hil_bench("schedulability --bitrate 125000 " + contract);
  EXPECT_EQ(overloaded.code, 1) << overloaded.err;
  EXPECT_THAT(overloaded.out,
              ContainsRegex("NOT schedulable: [0-9]+ of [0-9]+ messages: .* and [0-9]+ more\n"));
}

TEST(SimulatedWire, AFullWireFailsTheCheckOfItsLoad) {
  std::ofstream(scratch("full.toml")) << read(scenario("transfer_alignment_quick"))
                                      << "\n[[check]]\nkind = \"bus_load\"\nbitrate_kbitps = 1000\n"
                                         "below_percent = 50\n";
  const auto load_at = [&](const std::string& bus) {
    const std::string report = scratch("full.json");
    const Ended ended =
        hil_bench(fmt::format("run {} --bus '{}' --json {}", scratch("full.toml"), bus, report));
    EXPECT_NE(ended.code, 2) << ended.err;
    nlohmann::json page = read_json(report);
    const auto check =
        std::ranges::find_if(page["checks"], [](const auto& c) { return c["kind"] == "bus_load"; });
    EXPECT_NE(check, page["checks"].end());
    return std::pair((*check)["outcome"].template get<std::string>(),
                     page["bus_load"][0]["busiest_second"].template get<double>());
  };
  EXPECT_EQ(load_at("in-process?bitrate=1000000").first, "pass");
  const auto [outcome, busiest] = load_at("in-process?bitrate=100000");
  EXPECT_EQ(outcome, "fail");
  EXPECT_GT(busiest, 0.95);
  EXPECT_LE(busiest, 1.0 + 0.002) << "of a second, and at most one frame more";
}

TEST(Run, OfSeveralEstimatorsTheTextSaysWhoseLinesTheyAre) {
  const std::string text = hil_bench(fmt::format("run {} --bus in-process", scenario("all_four"))).out;
  EXPECT_THAT(text,
              ContainsRegex(
                  "\n  los_rate\n  end of the flight +the target was not passed\n  RMS .mrad/s. by s to go"));
  EXPECT_THAT(text, ContainsRegex("\n  wind\n  mean .error. from 10 s on"));
  EXPECT_THAT(text, ContainsRegex("\n  inflight_alignment\n  heading error"));
}

TEST(Run, ATargetHeldByASignalIsNamed) {
  const std::string held = scratch("held_target");
  std::ofstream(held) << "#!/bin/sh\n(sleep 1.5; kill -STOP $$) &\nexec " HIL_TARGET " \"$@\"\n";
  ASSERT_EQ(shell("chmod +x " + held).code, 0);
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --target {}", scenario("transfer_alignment"), bus(), held));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("fail: target silent since t="));
  EXPECT_THAT(ended.out, HasSubstr("(its process is stopped by a signal)"));
}

TEST(Run, AWireThatIsTooSlowIsNamed) {
  if (bus() != "local:") GTEST_SKIP() << "the bit rate is that of the interface";
  const Ended ended = hil_bench(fmt::format("run {} --bus 'local:?bitrate=125000'", scenario("all_four")));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("(the wire of 125 kbit/s is full: load "));
}

TEST(Run, WhatIsNoProgramIsRefusedAsTheTarget) {
  const std::string text = scratch("text_target"), plain = scratch("plain_target");
  for (const std::string& path : {text, plain}) std::ofstream(path) << "no program\n";
  ASSERT_EQ(shell(fmt::format("chmod 755 {}; chmod 644 {}", text, plain)).code, 0);
  for (const auto& [target, why] : {std::pair<std::string, std::string>{"/tmp", "Is a directory"},
                                    {text, "Exec format error"},
                                    {"/no/such", "No such file or directory"},
                                    {plain, "Permission denied"}}) {
    expect_one_line(
        hil_bench(
            fmt::format("run {} --bus {} --target {}", scenario("transfer_alignment_quick"), bus(), target)),
        fmt::format("target '{}': {}; expected an executable file, or --target none", target, why));
  }
}

TEST(Run, JsonToStdoutIsAloneThere) {
  const std::string noisy = scratch("noisy_target");
  std::ofstream(noisy) << "#!/bin/sh\necho a target says hello\nexec " HIL_TARGET " \"$@\"\n";
  ASSERT_EQ(shell("chmod +x " + noisy).code, 0);
  const Ended ended = hil_bench(fmt::format("run {} --bus {} --lockstep --json - --target {}",
                                            scenario("transfer_alignment_quick"), bus(), noisy));
  EXPECT_EQ(json_of(ended.out)["provenance"]["clock"], "lockstep");
  EXPECT_THAT(ended.err, HasSubstr("a target says hello"));
}

// Each program checks at its end whether its standard output could be written.
TEST(Output, ThatIsLostIsSaid) {
  const std::string log = scratch("lost.log"), dbc = SOURCE_DIR "/dbc/canhil.dbc";
  ASSERT_THAT(
      hil_bench(fmt::format("run {} --bus in-process --log {}", scenario("transfer_alignment_quick"), log))
          .err,
      testing::IsEmpty());
  const std::vector<std::string> commands{HIL_TARGET " --replay " + log,
                                          HIL_TARGET " --version",
                                          HIL_BENCH " diverge " + log + " " + log,
                                          HIL_BENCH " --help",
                                          HIL_BENCH " schedulability --bitrate 500000 " + dbc,
                                          DBCGEN " --load " + dbc};
  for (const std::string& command : commands) {
    const Ended ended = shell(command + " > /dev/full");
    EXPECT_EQ(ended.code, 2) << command;
    EXPECT_THAT(ended.err, ContainsRegex("cannot (be written|write to file)")) << command;
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
  }
}

TEST(Run, CsvIsATableOfAllThatWasReported) {
  const std::string table = scratch("run.csv");
  const Ended ended = hil_bench(fmt::format(
      "run {}/bench/flights/transfer_alignment_quick.toml --bus in-process --csv {}", SOURCE_DIR, table));
  EXPECT_EQ(ended.code, 3) << ended.err;
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "t_s,estimator,quantity,unit,estimate,truth,error,sigma");
  std::map<std::string, int> lines;  // number of lines by quantity
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    ASSERT_GE(row.size(), 5U) << line;
    EXPECT_EQ(row[1], "transfer_alignment");
    ++lines[row[2]];
    if (row[2] != "attitude.heading") continue;
    ASSERT_GE(row.size(), 7U) << line;
    EXPECT_NEAR(std::stod(row[4]) - std::stod(row[5]), std::stod(row[6]), 1e-12) << line;
  }
  EXPECT_EQ(lines["attitude.heading"], 300) << "3 s at 100 Hz";
  EXPECT_EQ(lines["innovation.nis"], 30) << "3 s at 10 Hz";
  EXPECT_EQ(lines.size(), 16U);
}

TEST(Run, JsonToStdoutReplacesTheText) {
  const Ended ended = hil_bench(
      fmt::format("run {} --bus {} --lockstep --json -", scenario("transfer_alignment_quick"), bus()));
  const auto report = json_of(ended.out);
  EXPECT_EQ(report["provenance"]["clock"], "lockstep");
}

}  // namespace
}  // namespace canhil::test
