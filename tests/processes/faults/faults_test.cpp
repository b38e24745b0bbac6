// Tests hil-bench faults: the matrix has the correct content, kills and shards do not change the matrix, and
// a reduced scenario still shows the violation.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string file(const std::string& name, const std::string& text) {
  std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

// An outage of a seeker at 200 Hz.
const std::string seeker_away = R"(
[[fault]]
name = "seeker away"
kind = "lost"
messages = ["SeekerAntenna", "SeekerAngles", "SeekerMotion", "SeekerRange"]
from_s = 2
to_s = 2.3
)";

// Three faults: two of a seeker at 200 Hz (an outage, damaged frames), and one of a master INS (lost frames).
// The seeker and the master INS are in different scenarios.
std::string small_set() {
  return file("small.toml", seeker_away + R"([[fault]]
name = "one in ten damaged"
kind = "damaged"
messages = ["SeekerAngles"]
from_s = 2
to_s = 3
every = 10
[[fault]]
name = "master away"
kind = "lost"
messages = ["MasterInsVelocityNE"]
from_s = 2
to_s = 2.5
)");
}

std::string flown(const std::string& arguments) {
  const Ended ended = hil_bench("faults " + arguments);
  EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
  EXPECT_EQ(ended.err, "") << "progress is for a terminal";
  return ended.out;
}

std::string two() { return scenario("los_quick") + " " + scenario("transfer_alignment_quick"); }

TEST(Faults, MatrixHasARowAFaultAndAColumnAScenario) {
  const std::string page = scratch("matrix.html");
  const nlohmann::json matrix = json_of(flown(
      fmt::format("{} --set {} --out {} --json - --html {}", two(), small_set(), scratch("matrix"), page)));
  EXPECT_EQ(matrix["outcome"], "pass") << matrix.dump(1);
  EXPECT_THAT(matrix["rows"], ElementsAre("no fault", "seeker away", "one in ten damaged", "master away"));
  std::map<std::string, std::string> responses;
  for (const auto& cell : matrix["cells"])
    responses[fmt::format("{}, {}", cell["row"].get<std::string>(), cell["column"].get<std::string>())] =
        cell["words"];
  EXPECT_EQ(responses.size(), 5U) << "each scenario has its own nodes";
  EXPECT_EQ(responses["no fault, los_quick"], "tolerated");
  EXPECT_EQ(responses["no fault, transfer_alignment_quick"], "tolerated");
  EXPECT_THAT(responses["seeker away, los_quick"], HasSubstr("detected in"));
  EXPECT_THAT(responses["one in ten damaged, los_quick"], HasSubstr("(input_lost in a heartbeat)"));
  EXPECT_THAT(read(page), HasSubstr("one in ten damaged"));
}

TEST(Faults, TextAndMarkdownSayTheSame) {
  const std::string arguments = fmt::format("{} --set {} --out ", scenario("los_quick"), file("one.toml", R"(
[[fault]]
name = "angles away"
kind = "lost"
messages = ["SeekerAngles"]
from_s = 2
to_s = 2.3
)"));
  EXPECT_THAT(flown(arguments + scratch("text")), HasSubstr("  angles away  detected in"));
  EXPECT_THAT(flown(arguments + scratch("markdown") + " --markdown"),
              HasSubstr("| angles away | detected in"));
}

// Only one of three faults causes the violation: a signal of the accelerometer is stuck. The target does not
// detect this, and reports small sigmas.
TEST(Faults, AViolationIsMadeSmallAndShowsAgain) {
  const std::string storm = file("storm.toml", R"(
[[fault]]
name = "ship away"
together = "storm"
kind = "lost"
messages = ["SsblRelativeNE"]
from_s = 6
to_s = 8.5
[[fault]]
name = "accelerometer stuck"
together = "storm"
kind = "changed"
messages = ["SlaveImuDeltaV"]
signal = "delta_v_x_mps"
value = 0.22
from_s = 12
to_s = 13
every = 5
[[fault]]
name = "damaged"
together = "storm"
kind = "damaged"
messages = ["SlaveImuDeltaV"]
from_s = 3
to_s = 5
every = 20
)");
  const std::string out = scratch("storm");
  const Ended ended =
      hil_bench(fmt::format("faults {} --set {} --out {} --json -", scenario("inflight_quick"), storm, out));
  EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
  const nlohmann::json matrix = json_of(ended.out);
  ASSERT_EQ(matrix["cells"].size(), 2U);
  const nlohmann::json& cell = matrix["cells"][1];
  EXPECT_EQ(cell["response"], "violated");
  EXPECT_EQ(cell["check"], "honest");
  EXPECT_EQ(cell["faults"].size(), 3U);
  ASSERT_EQ(cell["least"].size(), 1U) << "one of the three matters";
  EXPECT_THAT(cell["least"][0].get<std::string>(), HasSubstr("accelerometer stuck"));
  const std::string least = out + "/" + cell["replay"].get<std::string>();
  EXPECT_GT(target_frames(out + "/violation-1.log").size(), 1000U);

  // `faults merge` prints the command that flies the reduced scenario of the report.
  const Ended merged = hil_bench(fmt::format("faults merge {}/faults.sqlite", out));
  EXPECT_THAT(merged.out, HasSubstr(fmt::format("hil-bench run {} --bus in-process", least)));
  const std::string log = scratch("again.log");
  const Ended again = hil_bench(fmt::format("run {} --bus in-process --log {} --json -", least, log));
  EXPECT_EQ(again.code, 1) << again.out << again.err;
  const nlohmann::json report = json_of(again.out);
  EXPECT_EQ(report["ending"]["completed"], true);
  EXPECT_EQ(report["checks"][0]["kind"], "honest");
  EXPECT_EQ(report["checks"][0]["outcome"], "fail");
  EXPECT_EQ(target_frames(log).size(), target_frames(out + "/violation-1.log").size());
}

TEST(Faults, ShardsAndAKillGiveTheSameBytes) {
  const std::string arguments = scenario("los_quick") + " --seed 3";
  const auto json_in = [](const std::string& folder) {
    return hil_bench(fmt::format("faults merge $(ls -r {}/*.sqlite) --json -", folder)).out;
  };
  const std::string whole = scratch("whole"), shards = scratch("shards"), killed = scratch("killed");
  hil_bench(fmt::format("faults {} --out {} --threads 1", arguments, whole));
  for (int i = 0; i < 3; ++i) hil_bench(fmt::format("faults {} --out {} --shard {}/3", arguments, shards, i));
  EXPECT_GT(json_in(whole).size(), 1000U);
  EXPECT_TRUE(json_in(whole) == json_in(shards));

  // The program is killed when it has stored some cells.
  const std::string cells = killed + "/faults.sqlite";
  const pid_t child = fork();
  if (child == 0) {
    fclose(stdout);
    execl(HIL_BENCH, HIL_BENCH, "faults", scenario("los_quick").c_str(), "--seed", "3", "--out",
          killed.c_str(), "--threads", "1", nullptr);
    _exit(127);
  }
  const auto size = [&] { return fs::exists(cells) ? fs::file_size(cells) : 0; };
  while (size() == 0 && waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // three commits
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  expect_one_line(hil_bench(fmt::format("faults merge {} --json -", cells)), "expected all");
  expect_one_line(hil_bench(fmt::format("faults {} --out {}", arguments, killed)),
                  "exists already, expected a new file (or --resume)");
  hil_bench(fmt::format("faults {} --out {} --resume", arguments, killed));
  EXPECT_TRUE(json_in(whole) == json_in(killed));
}

TEST(Faults, InterruptedIsNotMeasured) {
  // Interrupts the command as soon as the first cell is stored.
  const Ended ended =
      shell(fmt::format("{0} faults {1} --runs 1000 --out {2} & "
                        "for i in $(seq 1000); do [ -s {2}/faults.sqlite ] && break; sleep 0.02; done; "
                        "kill -INT $!; wait $!",
                        HIL_BENCH, scenario("los_quick"), scratch("interrupted")));
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("interrupted; --resume goes on"));
  EXPECT_EQ(ended.out, "");
}

TEST(Faults, BadInputIsOneLine) {
  const std::string los = scenario("los_quick");
  expect_one_line(hil_bench("faults"), "SCENARIO, or merge");
  expect_one_line(hil_bench("faults none.toml"), "none.toml: cannot be read");
  expect_one_line(hil_bench(fmt::format("faults {} --set {}", los, file("none.toml", "a = 1\n"))),
                  "none.toml");
  expect_one_line(
      hil_bench(fmt::format("faults {} --set {}", los,
                            file("master.toml",
                                 "[[fault]]\nname = 'm'\nkind = 'lost'\n"
                                 "messages = ['MasterInsVelocityNE']\n"))),
      "master.toml:4: key 'fault[1].messages': 'MasterInsVelocityNE' is unknown, expected one of: Seeker");
  expect_one_line(
      hil_bench(fmt::format("faults {} {} --set {}", los, scenario("inflight_quick"),
                            file("ssbl.toml", "[[fault]]\nkind = 'lost'\nnode = 'master_ins'\n"))),
      "and it fits no other scenario");
  expect_one_line(hil_bench(fmt::format("faults {} --shard 3/3 --out {}", los, scratch("none"))),
                  "shard '3/3'");
  expect_one_line(hil_bench("faults merge " + los), "is not an SQLite file");
  expect_one_line(hil_bench(fmt::format("faults {} --set {} --seed 4", los, small_set())),
                  "--seed: has no effect beside --set");
  EXPECT_FALSE(fs::exists(scratch("none")));
}

// A campaign over faults is what `hil-bench faults` flies, with variants, metrics and checks of its own.
TEST(Faults, AreVariantsOfACampaign) {
  const std::string folder = scratch("campaign");
  fs::create_directories(folder);
  std::ofstream(folder + "/away.toml") << seeker_away;
  std::ofstream(folder + "/c.toml") << fmt::format(R"(
title = "Glint and losses"
runs = 2
[faults]
set = "away.toml"
[[variant]]
name = "as shipped"
scenario = "{0}"
[[variant]]
name = "late"
scenario = "{0}"
set = {{ "seeker.latency_ms" = 2.0 }}
[[check]]
name = "no answer is lost"
kind = "answers"
answers_at_least = 1100
[[metric]]
kind = "to_go"
quantity = "los.rate.pitch"
time_to_go_s = [1.0, 2.0]
rms_at_most_mradps = 5
)",
                                                   scenario("los_quick"));
  const std::string results = folder + "/c.sqlite";
  const Ended ended = hil_bench(fmt::format("campaign {0}/c.toml --out {0} --json -", folder));
  const nlohmann::json report = json_of(ended.out);
  EXPECT_EQ(ended.code, 1) << ended.err;
  ASSERT_EQ(report["cells"].size(), 8U) << "2 variants x (none, 1 fault) x 2 runs";
  for (const auto& cell : report["cells"]) {
    const bool faulty = cell["row"] == "seeker away";
    EXPECT_EQ(cell["response"], faulty ? "violated" : "tolerated") << cell;
    EXPECT_EQ(cell.value("check", ""), faulty ? "no answer is lost" : "");
  }
  ASSERT_EQ(report["answers"].size(), 4U) << "the metric of each variant with each fault";
  for (const auto& answer : report["answers"]) EXPECT_EQ(answer["outcome"], "pass") << answer;
  // The saved scenario has the check of the campaign and the value of its variant.
  const std::string saved = folder + "/" + report["cells"].back()["replay"].get<std::string>();
  EXPECT_THAT(read(saved), HasSubstr("latency_ms = 2\n"));
  const Ended again = hil_bench(fmt::format("run {} --bus in-process --json -", saved));
  EXPECT_EQ(json_of(again.out)["checks"][0]["name"], "no answer is lost");
  EXPECT_EQ(again.code, 1);
  const Ended replayed =
      hil_bench(fmt::format("campaign replay {}/c.toml 1 --variant 'late, seeker away' --json -", folder));
  EXPECT_EQ(replayed.code, 1) << replayed.err;
  EXPECT_EQ(json_of(replayed.out)["faults"][0]["name"], "seeker away");
}

std::string recommended() {
  return fmt::format("{} {} {} {}", scenario("transfer_alignment_quick"), scenario("inflight_quick"),
                     scenario("los_quick"), scenario("wind_recommended"));
}

// believed.toml lists known faults; each of them makes one estimator violate the check `honest`. A fault that
// no longer causes such a violation must be removed from believed.toml and from docs/fault-matrix.md.
TEST(Faults, WhatIsKnownToBeBelievedIsEachOfOneEstimator) {
  const Ended ended =
      hil_bench(fmt::format("faults {} --set {}/bench/campaign/matrix/believed.toml --out {} --json -",
                            recommended(), SOURCE_DIR, scratch("believed")));
  EXPECT_EQ(ended.code, 1) << ended.err;
  const nlohmann::json matrix = nlohmann::json::parse(ended.out);
  std::map<std::string, int> believed;
  for (const auto& cell : matrix["cells"]) {
    int& count = believed[cell["row"]];
    if (cell["response"] != "violated") continue;
    EXPECT_EQ(cell["check"], "honest") << cell;
    ++count;
  }
  EXPECT_EQ(believed.extract("no fault").mapped(), 0);
  EXPECT_EQ(believed.size(), 9U);
  for (const auto& [fault, count] : believed) EXPECT_EQ(count, 1) << fault;
}

TEST(Documentation, HasTheMatrixOfTheFourEstimators) {
  const Ended ended =
      hil_bench(fmt::format("faults {} --out {} --markdown", recommended(), scratch("documented")));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(read(SOURCE_DIR "/docs/fault-matrix.md"), testing::EndsWith(ended.out));
}

}  // namespace
}  // namespace canhil::test
