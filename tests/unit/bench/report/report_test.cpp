// Reports are well-formed for all names, and files are written completely or not at all.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/bindings/canhil.hpp"
#include "bench/estimators/inflight_alignment/answers.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/report/file.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/sensors/fins.hpp"
#include "bench/sensors/glider_nav.hpp"
#include "bench/sensors/master_ins.hpp"
#include "bench/sensors/seeker.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/world/motion/rest.hpp"
#include "tests/own_folder.hpp"

namespace canhil::report {
namespace {

using checks::Outcome;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::string awkward = "a<b> & \"c\" 'd' \x01\n\xC2\xB5";

scenario::Scenario scenario_of() {
  scenario::Scenario scenario;
  scenario.binding = bindings::canhil();
  scenario.title = awkward;
  scenario.duration_us = 1'000'000;
  return scenario;
}

drive::Run run_of() {
  return {.verdict = {.outcome = Outcome::fail,
                      .reason = "1 of 3 checks failed",
                      .checks = {{awkward, "kind", awkward, Outcome::fail, "5 < 6", "> 7"},
                                 {"two", "kind", "", Outcome::not_measured, "late", "x"},
                                 {"three", "kind", "", Outcome::pass, "1", "1"}}},
          .ending = {},
          .seen = {},
          .truth = {{.start = {}, .motion = world::Rest{}}, 1'000'000, 10'000},
          .options = {},
          .host = {},
          .wall_s = 1.5};
}

boost::property_tree::ptree suite_of(const drive::Run& run) {
  std::istringstream text(junit(scenario_of(), run));
  boost::property_tree::ptree xml;
  read_xml(text, xml);
  return xml.get_child("testsuites.testsuite");
}

std::map<std::string, std::string> properties_of(const boost::property_tree::ptree& test_case) {
  std::map<std::string, std::string> properties;
  for (const auto& [tag, property] : test_case.get_child("properties"))
    properties[property.get<std::string>("<xmlattr>.name")] = property.get<std::string>("<xmlattr>.value");
  return properties;
}

TEST(Junit, CarriesWhatAPassedCheckMeasuredAndWhenTheRunBegan) {
  drive::Run run = run_of();
  EXPECT_FALSE(suite_of(run).get_optional<std::string>("<xmlattr>.timestamp")) << "not known";
  run.started_s = 86'400;
  const auto suite = suite_of(run);
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.timestamp"), "1970-01-02T00:00:00Z");
  const auto properties = properties_of(suite.rbegin()->second);
  EXPECT_EQ(properties, (std::map<std::string, std::string>{{"measured", "1"}, {"expected", "1"}}));
}

// A run whose last check has numbers.
drive::Run run_with_numbers(Outcome outcome = Outcome::pass) {
  drive::Run run = run_of();
  checks::CheckResult& check = run.verdict.checks.back();
  check.outcome = outcome;
  check.judgement = {.criterion = {.quantity = "los.rate",
                                   .estimator = "los_rate",
                                   .statistic = "rms",
                                   .upper = checks::exclusive(2.5),
                                   .unit = "mrad/s",
                                   .stretch = checks::Stretch{.window = {.from_us = 0, .to_us = 700'000}}},
                     .measurement = {.value = 2, .count = 200, .worst_at_us = 555'000}};
  return run;
}

TEST(Junit, CarriesTheNumbersOfACheck) {
  const auto properties = properties_of(suite_of(run_with_numbers()).rbegin()->second);
  EXPECT_EQ(properties, (std::map<std::string, std::string>{{"measured", "1"},
                                                            {"expected", "1"},
                                                            {"value", "2"},
                                                            {"limit", "< 2.5 mrad/s"},
                                                            {"unit", "mrad/s"},
                                                            {"margin", "0.2"},
                                                            {"worst_at_s", "0.555"}}));
}

TEST(Junit, NamesTheScenarioInTheClassName) {
  const auto class_name = [](const std::string& file) {
    scenario::Scenario scenario = scenario_of();
    scenario.file = file;
    std::istringstream text(junit(scenario, run_of()));
    boost::property_tree::ptree xml;
    read_xml(text, xml);
    return xml.get_child("testsuites.testsuite").rbegin()->second.get<std::string>("<xmlattr>.classname");
  };
  EXPECT_EQ(class_name("flights/los quick.toml"), "flights.los quick.kind");
  EXPECT_EQ(class_name("/a/b/./c.toml"), "a.b.c.kind");
  EXPECT_EQ(class_name("../../c.toml"), "c.kind");
  EXPECT_EQ(class_name(""), "kind");
}

TEST(JsonReport, CarriesTheNumbersOfACheck) {
  const auto page = nlohmann::ordered_json::parse(json(scenario_of(), run_with_numbers()));
  EXPECT_FALSE(page["checks"][0].contains("value"));
  nlohmann::ordered_json check = page["checks"][2];
  for (const char* key : {"name", "kind", "requirement", "outcome", "measured", "expected"}) check.erase(key);
  EXPECT_EQ(check, nlohmann::ordered_json::parse(R"({"quantity": "los.rate", "estimator": "los_rate",
      "statistic": "rms", "value": 2.0, "upper": 2.5, "upper_inclusive": false, "unit": "mrad/s",
      "margin": 0.2, "count": 200, "from_s": 0.0, "to_s": 0.7, "worst_at_s": 0.555})"));
  drive::Run by_time_to_go = run_with_numbers();
  by_time_to_go.verdict.checks.back().judgement.criterion.stretch->to_go_s = {2, 3};
  const auto other = nlohmann::json::parse(json(scenario_of(), by_time_to_go))["checks"][2];
  EXPECT_EQ(other["time_to_go_s"], (nlohmann::json{2.0, 3.0}));
  EXPECT_FALSE(other.contains("from_s"));
}

TEST(TextReport, SaysWhenTheWorstValueOfAFailedCheckCame) {
  EXPECT_THAT(text(scenario_of(), run_with_numbers()), Not(HasSubstr("worst")));
  drive::Run failed = run_with_numbers(Outcome::fail);
  EXPECT_THAT(text(scenario_of(), failed), HasSubstr("1, worst at 0.555 s  (expected 1)\n"));
  failed.verdict.checks.back().measured = "9 sigma at 0.555 s";
  EXPECT_THAT(text(scenario_of(), failed), HasSubstr("9 sigma at 0.555 s  (expected 1)\n")) << "once";
}

TEST(Junit, EscapesWhatXmlForbids) {
  const auto suite = suite_of(run_of());
  const std::string readable = "a<b> & \"c\" 'd' \\x01 \xC2\xB5";
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.name"), readable);
  // Skips attributes, properties and the test case of the run itself.
  auto second = std::next(suite.begin(), 3)->second;
  EXPECT_EQ(second.get<std::string>("<xmlattr>.name"), readable);
  EXPECT_EQ(properties_of(second).at("requirement"), readable);
  EXPECT_EQ(second.get<std::string>("failure.<xmlattr>.message"), "5 < 6; expected > 7");
}

TEST(Junit, CountsWhatItLists) {
  const auto suite = suite_of(run_of());
  EXPECT_EQ(suite.get<std::size_t>("<xmlattr>.tests"), 4U);
  EXPECT_EQ(suite.count("testcase"), 4U);
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 1);
  EXPECT_EQ(suite.get<int>("<xmlattr>.skipped"), 1);
}

TEST(Junit, ARunThatEndedEarlyIsAFailureAndAnInterruptedOneIsSkipped) {
  drive::Run run = run_of();
  run.verdict.checks.clear();
  run.ending = {.kind = drive::Ending::Kind::target_silent, .t_us = 5, .detail = "silent"};
  EXPECT_EQ(suite_of(run).get<int>("<xmlattr>.failures"), 1);
  run.ending = {.kind = drive::Ending::Kind::interrupted, .t_us = 5, .detail = "interrupted"};
  EXPECT_EQ(suite_of(run).get<int>("<xmlattr>.failures"), 0);
  EXPECT_EQ(suite_of(run).get<int>("<xmlattr>.skipped"), 1);
}

TEST(JsonReport, CarriesEveryStringAsItIs) {
  const auto page = nlohmann::json::parse(json(scenario_of(), run_of()));
  EXPECT_EQ(page["title"], awkward);
  EXPECT_EQ(page["checks"][0]["name"], awkward);
  EXPECT_EQ(page["verdict"], "fail");
  EXPECT_EQ(page["checks"][1]["outcome"], "not measured");
}

TEST(JsonReport, AFileNameThatIsNoUtf8DoesNotEndIt) {
  scenario::Scenario scenario = scenario_of();
  scenario.file = "\xFF.toml";
  const auto page = nlohmann::json::parse(json(scenario, run_of()));
  EXPECT_EQ(page["provenance"]["scenario"], "\xEF\xBF\xBD.toml");
}

TEST(Reports, NameAPeriodThatIsNotTheDbcs) {
  scenario::Scenario scenario = scenario_of();
  EXPECT_THAT(text(scenario, run_of()), Not(HasSubstr("DBC:")));
  const scenario::Schedule often{.period_us = 20'000, .latency_us = 0};
  const scenario::Schedule as_in_the_dbc{
      .period_us = nodes::bound(sensors::seeker).table.closes->cycle_time_us, .latency_us = 0};
  scenario.nodes.emplace_back(nodes::bound(sensors::fins).table, sensors::FinsSettings{.schedule = often});
  scenario.nodes.emplace_back(nodes::bound(sensors::glider_nav).table, sensors::GliderNavSettings{});
  scenario.nodes.emplace_back(nodes::bound(sensors::master_ins).table,
                              sensors::MasterInsSettings{.schedule = often});
  scenario.nodes.emplace_back(nodes::bound(sensors::slave_imu).table,
                              sensors::SlaveImuSettings{.schedule = often});
  scenario.nodes.emplace_back(nodes::bound(sensors::seeker).table,
                              sensors::SeekerSettings{.schedule = as_in_the_dbc});
  EXPECT_THAT(text(scenario, run_of()), HasSubstr("SlaveImu every 20 ms (DBC: 10 ms)"));
  const auto page = nlohmann::json::parse(json(scenario, run_of()));
  EXPECT_THAT(page["provenance"]["period_overrides"],
              testing::ElementsAre("SlaveImu every 20 ms (DBC: 10 ms)", "MasterIns every 20 ms (DBC: 100 ms)",
                                   "Fins every 20 ms (DBC: 10 ms)"));
}

TEST(Reports, TellWhatBecameOfFixes) {
  drive::Run run = run_of();
  scenario::Scenario scenario = scenario_of();
  scenario.targets = {
      {.estimator = "inflight_alignment", .algorithm = "sin_cos", .initial_sigma = {}, .parameters = {}}};
  EXPECT_THAT(text(scenario, run), AllOf(HasSubstr("answers 0\n"), Not(HasSubstr("accepted"))));
  estimators::FixAnswer fix{.cause_us = 100'000};
  fix.attitude_sigma.z() = 0.01;
  run.seen.of<estimators::InflightAnswers>().fixes =
      estimators::InOrderOfCause<estimators::FixAnswer>(std::vector{fix, fix, fix});
  EXPECT_THAT(
      text(scenario, run),
      AllOf(
          HasSubstr("repairs of the covariance 0, heading not fed back to the INS by the end, heading sigma "
                    "reported at the end 0.573 deg\n"),
          HasSubstr("answers 0, accepted 3\n")));
  run.seen.of<estimators::InflightAnswers>().fixes[1].outcome = messages::FixOutcome::gated;
  run.seen.of<estimators::InflightAnswers>().fixes[1].cause_us = 200'000;
  run.seen.of<estimators::InflightAnswers>().fixes[1].handed_over =
      run.seen.of<estimators::InflightAnswers>().fixes[2].handed_over = true;
  run.seen.of<estimators::InflightAnswers>().fixes[2].repairs = 4;
  run.seen.of<estimators::InflightAnswers>().fixes[2].repaired = true;
  EXPECT_THAT(
      text(scenario, run),
      AllOf(HasSubstr("repairs of the covariance 4, heading fed back to the INS at 0.2 s, heading sigma"),
            HasSubstr("accepted 2, gated 1, repaired 1, handed_over 2\n")));
  const auto results = nlohmann::json::parse(json(scenario, run))["results"]["inflight_alignment"];
  EXPECT_EQ(results["answers"]["figures"]["gated"]["value"], 1);
  EXPECT_EQ(results["answers"]["figures"]["late"]["value"], 0) << "programs too are given none";
  EXPECT_EQ(results["filter"]["figures"]["resolved"]["value"], 0.2);
  EXPECT_EQ(results["filter"]["figures"]["repairs"]["value"], 4);
}

TEST(Reports, SayNothingOfAHandOverWhereTheAlgorithmHasNone) {
  drive::Run run = run_of();
  run.seen.of<estimators::InflightAnswers>().fixes.push_back(
      {.cause_us = 100'000, .attitude_sigma = {0, 0, 0.01}});
  scenario::Scenario scenario = scenario_of();
  scenario.targets = {
      {.estimator = "inflight_alignment", .algorithm = "ukf", .initial_sigma = {}, .parameters = {}}};
  EXPECT_THAT(text(scenario, run),
              HasSubstr("repairs of the covariance 0, heading sigma reported at the end 0.573 deg\n"));
  const auto page = nlohmann::json::parse(json(scenario, run));
  EXPECT_FALSE(page["results"]["inflight_alignment"]["filter"]["figures"].contains("resolved"));
}

TEST(Reports, TellTheLoadAtTheRateOfTheWire) {
  drive::Run run = run_of();
  EXPECT_THAT(text(scenario_of(), run),
              AllOf(HasSubstr("bus load at 500 kbit/s"), HasSubstr("bus load at 1000 kbit/s")));
  run.seen.bit_rates = {.nominal = 250'000, .data = 2'000'000};
  EXPECT_THAT(text(scenario_of(), run),
              ContainsRegex("bus load at 250 kbit/s +mean 0.0 %, busiest second 0.0 %\n"));
  auto report = nlohmann::json::parse(json(scenario_of(), run));
  ASSERT_THAT(report["bus_load"], testing::SizeIs(1));
  EXPECT_EQ(report["bus_load"][0]["bitrate_bitps"], 250'000);
  EXPECT_EQ(report["bus_load_line"]["bitrate_bitps"], 250'000);
  run.options.format = BusFormat::fd;
  EXPECT_THAT(text(scenario_of(), run), HasSubstr("bus load at 250 and 2000 kbit/s"));
}

TEST(Reports, TellThatTheTargetsOwnAccountEnds) {
  drive::Run run = run_of();
  run.seen.target_timing_seen = true;
  run.seen.queue_max_us = 8190;
  run.seen.compute_max_us = 8191;
  EXPECT_THAT(text(scenario_of(), run), HasSubstr("queue max 8190 us  compute max 8191 us or more\n"));
}

TEST(Reports, SayOfSeveralEstimatorsWhoseLinesTheyAre) {
  scenario::Scenario scenario = scenario_of();
  for (const char* estimator : {"transfer_alignment", "wind"})
    scenario.targets.push_back(
        {.estimator = estimator, .algorithm = "x", .initial_sigma = {}, .parameters = {}});
  EXPECT_THAT(text(scenario, run_of()), HasSubstr("\n  transfer_alignment\n  heading error"));
  scenario.targets.pop_back();
  EXPECT_THAT(text(scenario, run_of()), Not(HasSubstr("\n  transfer_alignment\n"))) << "there is no other";
}

TEST(Reports, TellWhatTheBusDid) {
  drive::Run run = run_of();
  EXPECT_THAT(text(scenario_of(), run), HasSubstr("0 error frames; interface down 0 times; late in transmit "
                                                  "queue 0 frames"));
  run.seen.first_ns = 1'000'000'000;
  run.seen.bus.errors = {.frames = 2, .bus_off = 1, .restarted = 1, .tx_counter_max = 136};
  run.seen.bus.incidents = {{.t_ns = 1'500'000'000, .event = BusEvent::bus_off, .tx_counter = 136},
                            {.t_ns = 1'600'000'000, .event = BusEvent::restarted}};
  run.seen.bus.late_in_queue = 7;
  const std::string page = text(scenario_of(), run);
  EXPECT_THAT(page, HasSubstr("2 error frames (bus off 1, restarted 1; error counters at most tx 136, rx 0); "
                              "interface down 0 times; late in transmit queue 7 frames\n"
                              "    t=0.500 s  bus off (tx 136, rx 0)\n"
                              "    t=0.600 s  restarted (tx 0, rx 0)\n"));
  const auto report = nlohmann::json::parse(json(scenario_of(), run));
  EXPECT_EQ(report["bus"]["bus_off"], 1);
  EXPECT_EQ(report["bus"]["late_in_queue"], 7);
  EXPECT_EQ(report["bus"]["incidents"][0]["t_s"], 0.5);
  EXPECT_EQ(report["bus"]["incidents"][0]["event"], "bus off");
  run.seen.bus.incidents.resize(25);
  run.seen.bus.more_incidents = 10;
  EXPECT_THAT(text(scenario_of(), run), HasSubstr("    and 15 more\n"));
}

TEST(Reports, NameTheControllersStamps) {
  drive::Run run = run_of();
  EXPECT_THAT(text(scenario_of(), run), Not(HasSubstr("hardware")));
  run.seen.timing.stimuli_with_hardware_stamp = 1;
  EXPECT_THAT(text(scenario_of(), run), HasSubstr("latency by the controller's hardware stamps"));
}

TEST(File, IsWholeOrNotThere) {
  const std::filesystem::path folder = std::filesystem::path(test::own_folder()) / "whole";
  std::filesystem::create_directories(folder);
  const std::string path = folder / "report.json";
  ASSERT_TRUE(write_file(path, "first"));
  ASSERT_TRUE(write_file(path, "second"));
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "second");
  EXPECT_FALSE(write_file(folder / "no" / "such", "x"));
  EXPECT_FALSE(write_file(folder, "x"));
  EXPECT_FALSE(check_writable(folder));
  EXPECT_FALSE(check_writable(folder / "no" / "such"));
  EXPECT_TRUE(check_writable(path));
  EXPECT_FALSE(check_writable("/proc/no_report")) << "where nobody may write, root neither";
  EXPECT_FALSE(check_writable(folder / std::string(250, 'n'))) << "longer than allowed until it is whole";
  EXPECT_THAT(check_writable(folder / std::string(300, 'n')).error().message,
              HasSubstr("File name too long"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing unfinished stays";
  std::filesystem::remove_all(folder);
}

TEST(File, ThatAnotherProcessIsWritingIsLeftAlone) {
  const std::filesystem::path folder = test::own_folder();
  const std::string path = folder / "report.json";
  const pid_t other = fork();
  if (other == 0) _exit(write_file(path, std::string(1 << 16, 'b')) ? 0 : 1);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(write_file(path, std::string(1 << 16, 'a')));
    std::ifstream file(path);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    ASSERT_EQ(content, std::string(1 << 16, content.at(0))) << "of one of them alone, and whole";
  }
  int status = -1;
  waitpid(other, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace canhil::report
