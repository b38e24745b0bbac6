// Tests hil-bench campaign: neither the number of threads nor shards nor kills change the merged file, and an
// error message has one line.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// A campaign file with two variants of the quick flight, each with a sweep.
std::string campaign_file(int runs = 30) {
  std::string file = scratch(fmt::format("campaign{}.toml", runs));
  std::ofstream(file) << fmt::format(R"(title = "Short"
runs = {}
seed = 11
[[variant]]
name = "KF"
scenario = "{}"
[[variant]]
name = "H2"
scenario = "{}"
set = {{ "target.algorithm" = "robust_h2" }}
[sweep]
"master_ins.latency_ms" = [0, 100]
[[metric]]
kind = "rms_curve"
quantity = "attitude.heading"
[[metric]]
name = "heading at 2 s"
kind = "value_at"
quantity = "attitude.heading"
at_s = 2.0
variants = ["KF"]
at_most_mrad = 200
)",
                                     runs, scenario("transfer_alignment_quick"),
                                     scenario("transfer_alignment_quick"));
  return file;
}

/// Makes an empty folder and returns its path.
std::string folder(const std::string& name) {
  std::string path = scratch(name);
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

void expect_done(const Ended& ended) { EXPECT_EQ(ended.code, 0) << ended.out << ended.err; }

std::string merged(const std::string& in, const std::string& arguments = "*.sqlite") {
  const std::string out = in + "/merged.db";
  expect_done(hil_bench(fmt::format("campaign merge {} $(ls -r {}/{})", out, in, arguments)));
  return read(out);
}

/// The content of the merged file of an undisturbed campaign on one thread.
const std::string& undisturbed() {
  static const std::string bytes = [] {
    const std::string at = folder("undisturbed");
    expect_done(hil_bench(fmt::format("campaign {} --out {} --threads 1", campaign_file(), at)));
    return merged(at);
  }();
  return bytes;
}

class Divided : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Divided, GivesTheSameMergedBytes) {
  const auto [shards, threads] = GetParam();
  const std::string at = folder(fmt::format("shards-{}-{}", shards, threads));
  for (int i = 0; i < shards; ++i) {
    expect_done(hil_bench(fmt::format("campaign {} --out {} --threads {} --shard {}/{}", campaign_file(), at,
                                      threads, i, shards)));
  }
  EXPECT_TRUE(merged(at) == undisturbed());
}

INSTANTIATE_TEST_SUITE_P(ShardsAndThreads, Divided,
                         testing::Values(std::pair{1, 1}, std::pair{1, 2}, std::pair{3, 1}, std::pair{3, 2},
                                         std::pair{7, 1}, std::pair{7, 2}));

/// Starts hil-bench campaign and kills it after this time, if it has not ended by then. Returns whether it
/// was killed.
bool start_and_kill(const std::string& file, const std::string& out, std::chrono::milliseconds after) {
  const pid_t child = fork();
  if (child == 0) {
    fclose(stdout);
    execl(HIL_BENCH, HIL_BENCH, "campaign", file.c_str(), "--out", out.c_str(), "--resume", nullptr);
    _exit(127);
  }
  std::this_thread::sleep_for(after);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

TEST(Killed, AndResumedItLosesAndRepeatsNothing) {
  constexpr int kills = 20;
  const std::string file = campaign_file(1000), at = folder("killed"), calm = folder("calm");
  const auto start = std::chrono::steady_clock::now();
  expect_done(hil_bench(fmt::format("campaign {} --out {}", file, calm)));
  const auto whole = std::chrono::steady_clock::now() - start;

  // The kills are spread over the whole duration of the campaign, including its start and the commits of
  // results.
  std::mt19937_64 random(20010101);
  int killed = 0;
  for (int i = 0; i < kills; ++i) {
    const auto after = whole / kills * std::uniform_real_distribution(0.0, 2.0)(random);
    killed += start_and_kill(file, at, std::chrono::duration_cast<std::chrono::milliseconds>(after)) ? 1 : 0;
  }
  EXPECT_GT(killed, kills / 2) << "the campaign was over too early to be killed";
  expect_done(hil_bench(fmt::format("campaign {} --out {} --resume", file, at)));
  EXPECT_TRUE(merged(at) == merged(calm));
  expect_done(hil_bench(fmt::format("campaign {} --out {} --resume", file, at)));  // no run is left to do
}

TEST(Interrupted, KeepsWhatItHasAndSaysHowToGoOn) {
  const std::string at = folder("interrupted");
  const auto after = [&](double time_s) {  // a signal before the first run ends the program without a message
    return shell(fmt::format("timeout -s INT {} {} campaign {} --out {}; exit $?", time_s, HIL_BENCH,
                             campaign_file(2000), at));
  };
  Ended ended = after(0.4);
  for (const double time_s : {2.0, 8.0}) {  // on a slow host, the signal must come later
    if (ended.err.empty()) ended = after(time_s);
  }
  EXPECT_THAT(ended.err, HasSubstr("interrupted; --resume goes on"));
}

TEST(Slurm, TaskOfAnArrayIsAShard) {
  const std::string at = folder("slurm");
  for (int i = 1; i <= 3; ++i) {
    expect_done(shell(
        fmt::format("SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 {} campaign {} "
                    "--out {}",
                    i, HIL_BENCH, campaign_file(), at)));
    EXPECT_TRUE(fs::exists(fmt::format("{}/campaign30-{}-of-3.sqlite", at, i - 1)));
  }
  EXPECT_TRUE(merged(at) == undisturbed());
}

TEST(Report, ComesFromTheMergedFileAlone) {
  const std::string at = folder("report");
  undisturbed();
  fs::copy(scratch("undisturbed") + "/merged.db", at + "/results");
  const Ended ended = hil_bench(fmt::format("campaign report {}/results --json -", at));
  expect_done(ended);
  const auto json = json_of(ended.out);
  EXPECT_EQ(json["variants"].size(), 4U);
  EXPECT_EQ(json["variants"][0]["completed"], 30);
  EXPECT_EQ(json["answers"][0]["curve"]["t_s"].size(), 29U);
  EXPECT_THAT(hil_bench(fmt::format("campaign report {}/results", at)).out, HasSubstr("heading at 2 s"));
}

TEST(Export, IsATableOfWhatTheRunsReported) {
  undisturbed();
  const std::string results = scratch("undisturbed") + "/merged.db";
  const Ended ended = hil_bench(fmt::format("campaign export {}", results));
  expect_done(ended);
  EXPECT_THAT(ended.out,
              testing::StartsWith("variant,run,t_s,quantity,unit,value\nKF master_ins.latency_ms=0,0,"));
  // The output has a header line and a line for each quantity (14) of each update. There are four variants
  // with 30 runs each. In two variants a run has 29 updates. In the other two, the master INS is 100 ms late,
  // and a run has 28 updates.
  EXPECT_EQ(std::ranges::count(ended.out, '\n'), 1 + 30 * (2 * 29 + 2 * 28) * 14);
  EXPECT_THAT(ended.out, testing::ContainsRegex(
                             "\nKF master_ins.latency_ms=0,29,[0-9.]+,attitude.heading,rad,-?[0-9.e-]+\n"));
  EXPECT_EQ(hil_bench(fmt::format("campaign export {}", results)).out, ended.out);
  const Ended some = hil_bench(fmt::format(
      "campaign export {} --variant 'KF master_ins.latency_ms=0' --quantity attitude.heading --to 1.05",
      results));
  EXPECT_EQ(std::ranges::count(some.out, '\n'), 1 + 30 * 10);
  expect_one_line(hil_bench(fmt::format("campaign export {} --quantity attitude.heeding", results)),
                  "expected 'attitude.heading'");
  expect_one_line(hil_bench(fmt::format("campaign export {} --format xls", results)),
                  "--format 'xls': is unknown, expected 'csv'");
  expect_one_line(hil_bench("campaign export none.sqlite"), "none.sqlite");
}

TEST(Report, ABarThatIsNotMetIsExitCode1) {
  std::string text = read(campaign_file(5));
  const std::string bar = "at_most_mrad = 200";
  text.replace(text.find(bar), bar.size(), "at_most_mrad = 0.001");
  std::ofstream(scratch("strict.toml")) << text;
  const Ended ended =
      hil_bench(fmt::format("campaign {} --out {}", scratch("strict.toml"), folder("strict")));
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("FAIL"));
}

// A check is judged in each run; a limit on the share of the runs that pass is met or not.
TEST(Checks, AreJudgedInEveryRun) {
  const std::string head = read(campaign_file(4)), at = folder("checks");
  const auto flown = [&](const std::string& checks) {
    std::ofstream(at + "/checked.toml") << head.substr(0, head.find("[[metric]]")) << checks;
    const Ended ended =
        hil_bench(fmt::format("campaign {0}/checked.toml --out {0} --json - --html {0}/page.html "
                              "--junit {0}/junit.xml --csv {0}/answers.csv",
                              at));
    fs::remove(at + "/checked.sqlite");
    EXPECT_EQ(ended.code, json_of(ended.out)["outcome"] == "pass" ? 0 : 1) << ended.err;
    return json_of(ended.out);
  };
  const auto error = [](const std::string& more) {
    return "[[check]]\nkind = 'error'\nquantity = 'attitude.heading'\nstatistic = 'final'\n" + more;
  };
  const auto passed = flown(error("below_deg = 90\n"));
  ASSERT_EQ(passed["answers"].size(), 4U) << "two variants at two points";
  const auto& answer = passed["answers"][0];
  EXPECT_EQ(answer["outcome"], "pass");
  EXPECT_EQ(answer["passed"], 4);
  EXPECT_EQ(answer["unit"], "deg");
  EXPECT_LT(answer["median"], answer["value"]) << "the value is that of the worst run";
  EXPECT_THAT(read(at + "/junit.xml"),
              HasSubstr("name=\"KF master_ins.latency_ms=0\" tests=\"1\" failures=\"0\""));
  EXPECT_THAT(read(at + "/page.html"), HasSubstr("4 of 4 runs pass"));
  EXPECT_THAT(read(at + "/answers.csv"), HasSubstr("KF master_ins.latency_ms=0,pass,"));

  // Between the median and the worst run, some runs pass.
  const double between = 0.5 * (answer["median"].get<double>() + answer["value"].get<double>());
  const std::string some = fmt::format("name = 'mine'\nbelow_deg = {}\nvariants = ['KF']\n", between);
  const auto failed = flown(error(some));
  ASSERT_EQ(failed["answers"].size(), 2U);
  EXPECT_EQ(failed["answers"][0]["outcome"], "fail");
  EXPECT_THAT(failed["answers"][0]["measured"].get<std::string>(), HasSubstr(" of 4 runs pass"));
  const double share = failed["answers"][0]["passed"].get<double>() / 4;
  EXPECT_GT(share, 0);
  EXPECT_EQ(flown(error(some + fmt::format("runs_at_least = {}\n", share)))["answers"][0]["outcome"], "pass");
  // The checks of the scenario, and a check that nothing can measure in virtual time.
  std::ofstream(at + "/timed.toml")
      << head.substr(0, head.find("[[metric]]"))
      << "[[check]]\nkind = 'latency'\nmessage = 'AlignAttitude'\nbelow_ms = 5\n";
  const Ended timed = hil_bench(fmt::format("campaign {0}/timed.toml --out {0}", at));
  EXPECT_EQ(timed.code, 3) << timed.out;
  EXPECT_THAT(timed.err, HasSubstr("was not measured (0 of 4 runs pass, 4 not measured"));
}

TEST(Report, OfACampaignThatAsksForNothingIsExitCode3) {
  const std::string text = read(campaign_file(2));
  std::ofstream(scratch("asks_nothing.toml")) << text.substr(0, text.find("[[metric]]"));
  const std::string at = folder("asks_nothing");
  for (const std::string& command : {"campaign " + scratch("asks_nothing.toml") + " --out " + at,
                                     "campaign report " + at + "/asks_nothing.sqlite"}) {
    const Ended ended = hil_bench(command);
    EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("seed 11 · not measured"));
    EXPECT_THAT(ended.err,
                HasSubstr("asks_nothing.toml: nothing was judged: no [[metric]] and no [[check]]\n"));
  }
}

TEST(Report, OfMetricsWithoutABarIsExitCode3) {
  std::string text = read(campaign_file(2));
  const std::string bar = "at_most_mrad = 200\n";
  std::ofstream(scratch("no_bar.toml")) << text.erase(text.find(bar), bar.size());
  const Ended ended =
      hil_bench(fmt::format("campaign {} --out {}", scratch("no_bar.toml"), folder("no_bar")));
  EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("no_bar.toml: nothing was judged: no [[metric]] has a limit\n"));
}

TEST(Report, OfResultsThatAreCutOffIsOneLine) {
  const std::string at = folder("cut_off"), whole = at + "/campaign5.sqlite";
  expect_done(hil_bench(fmt::format("campaign {} --out {}", campaign_file(5), at)));
  fs::resize_file(whole, fs::file_size(whole) - 1000);
  expect_one_line(hil_bench("campaign report " + whole), "of its pages: the file is cut off");
}

TEST(Replay, IsOneRunWithItsLog) {
  const std::string log = scratch("replay.log");
  const auto replay = [&] {
    return hil_bench(fmt::format("campaign replay {} 3 --variant 'H2 master_ins.latency_ms=100' --log {}",
                                 campaign_file(), log));
  };
  const Ended ended = replay();
  EXPECT_THAT(ended.out, HasSubstr("variant H2 master_ins.latency_ms=100 · run 3"));
  const auto frames = target_frames(log);
  EXPECT_GT(frames.size(), 300U);
  replay();
  EXPECT_EQ(target_frames(log), frames);
  expect_one_line(hil_bench(fmt::format("campaign replay {} 3 --variant H3", campaign_file())),
                  "variant 'H3' is unknown, expected");
}

TEST(Target, AProgramGivesTheSamplesOfTheDeviceInProcess) {
  const std::string file = campaign_file(3);
  const auto table = [&](const std::string& in, const std::string& arguments) {
    const Ended ended = hil_bench(fmt::format("campaign {} --out {} {}", file, in, arguments));
    expect_done(ended);
    return std::pair(ended.out, hil_bench(fmt::format("campaign export {}/campaign3.sqlite", in)).out);
  };
  const std::string against = folder("against");
  const auto [in_words, in_process] = table(folder("in_process"), "");
  const auto [against_words, over_the_bus] = table(against, "--threads 2 --target " HIL_TARGET);
  EXPECT_GT(in_process.size(), 1000U);
  EXPECT_TRUE(in_process == over_the_bus);
  EXPECT_THAT(in_words, Not(HasSubstr("target")));
  EXPECT_THAT(against_words, HasSubstr("target hil-target+"));
  expect_one_line(hil_bench(fmt::format("campaign {} --out {} --resume", file, against)),
                  "expected the bench's own device");
}

TEST(Target, IsStartedWithTheContractOfItsScenario) {
  const std::string arguments = scratch("arguments"), target = scratch("fd_target"), fd = scratch("fd.toml");
  std::ofstream(target) << fmt::format("#!/bin/sh\necho \"$@\" >> {}\nexec {} \"$@\"\n", arguments,
                                       HIL_TARGET);
  ASSERT_EQ(shell("chmod +x " + target).code, 0);
  std::ofstream(fd) << "dbc = \"canhil-fd\"\n" << read(scenario("transfer_alignment_quick"));
  const std::string file = scratch("fd_campaign.toml");
  std::ofstream(file) << fmt::format(
      "title = \"FD\"\nruns = 2\nseed = 1\n[[variant]]\nname = \"KF\"\nscenario = \"{}\"\n", fd);
  const Ended ended = hil_bench(fmt::format("campaign {} --out {} --target {}", file, folder("fd"), target));
  EXPECT_THAT(ended.out, HasSubstr("2 of 2 runs completed")) << ended.err;
  EXPECT_THAT(read(arguments), HasSubstr("--dbc canhil-fd"));
}

TEST(Target, ThatCannotBeFlownAgainstIsOneLine) {
  const auto against = [](const std::string& arguments) {
    return hil_bench(fmt::format("campaign {} --out {} {}", campaign_file(3), folder("nobody"), arguments));
  };
  expect_one_line(against("--target /no/such/program"), "target '/no/such/program': is not a program");
  expect_one_line(against("--target " + campaign_file(3)), "is not a program");
  expect_one_line(against("--target /usr/bin/true"), "target");
  EXPECT_FALSE(fs::exists(scratch("nobody/campaign3.sqlite")));
  expect_one_line(against("--unrounded --target " HIL_TARGET), "--unrounded");
}

// The runs are in process, because a run with a target program takes ten times as long and gives the same
// bits. With a sanitizer, two runs are enough to test memory. With so few runs, metrics may fail.
TEST(Acceptance, TheTargetIsWithinTheBarsOfEveryCampaign) {
#ifdef CANHIL_SANITIZED
  constexpr int runs = 2, worst_code = 1;
#else
  constexpr int runs = 60, worst_code = 0;
#endif
  for (const char* name : {"transfer_alignment", "inflight_alignment", "los_rate", "wind"}) {
    const Ended ended =
        hil_bench(fmt::format("campaign {}/bench/acceptance/{}/campaign.toml --runs {} --out {}", SOURCE_DIR,
                              name, runs, folder(name)));
    EXPECT_LE(ended.code, worst_code) << ended.out << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(fmt::format("{0} of {0} runs completed", runs)));
  }
}

TEST(CampaignBadInput, IsOneLine) {
  const std::string file = campaign_file(), at = folder("bad");
  const auto campaign = [&](const std::string& arguments) {
    return hil_bench(fmt::format("campaign {} {}", file, arguments));
  };
  expect_one_line(hil_bench("campaign"), "FILE, or merge, report, export or replay");
  expect_one_line(hil_bench("campaign none.toml"), "none.toml: cannot be read");
  expect_one_line(campaign("--shard 3/3"), "shard '3/3'");
  expect_one_line(campaign("--threads 0"), "--threads");
  expect_one_line(campaign("--runs 0"), "--runs");
  expect_one_line(campaign("--runs -3"), "--runs: '-3' is not a whole number from 1 to 10000000");
  expect_one_line(campaign("--runs 18446744073709551617"), "--runs");
  expect_one_line(campaign("--threads -1"), "--threads: '-1' is not a whole number from 1 to 1024");
  expect_one_line(hil_bench(fmt::format("campaign replay {} -1", file)), "RUN: '-1' is not a whole number");
  expect_one_line(hil_bench(fmt::format("campaign replay {} 1 --log -", file)),
                  "--log -: standard output cannot hold this");
  expect_one_line(hil_bench("campaign " + campaign_file(10'000'001)), "at most 10000000");
  expect_one_line(campaign("--out -"), "--out -: expected a folder or a file");
  expect_one_line(hil_bench("campaign merge - x.sqlite"), "OUT -: standard output cannot hold this");
  expect_one_line(campaign("--shard 0/2 --json x.json --out " + at), "a shard has no report");
  expect_one_line(campaign("--json /no/such/x.json --out " + at), "/no/such/x.json");
  expect_one_line(campaign("--out /dev/full"), "/dev/full");
  expect_one_line(campaign("--out /proc/none"), "/proc/none");  // a folder without write permission
  expect_one_line(campaign("--out /proc/none.sqlite"), "/proc/none.sqlite");
  expect_one_line(hil_bench(fmt::format("campaign merge {}/out.db {}", at, file)), "is not an SQLite file");
  expect_one_line(hil_bench("campaign report " + file), "is not an SQLite file");
}

TEST(CampaignBadInput, WhatIsReadIsNotWrittenOver) {
  const std::string at = folder("written_over");
  fs::copy_file(scenario("transfer_alignment_quick"), at + "/q.toml");
  std::ofstream(at + "/c.toml")
      << "title = 'T'\nruns = 1\nseed = 1\n[[variant]]\nname = 'A'\nscenario = 'q.toml'\n";
  const std::string campaign = read(at + "/c.toml"), flown = read(at + "/q.toml");
  for (const char* json : {"c.toml", "./c.toml", "q.toml", "o.sqlite"})
    expect_one_line(
        shell(fmt::format("cd {}; {} campaign c.toml --out o.sqlite --json {}", at, HIL_BENCH, json)),
        "is the same file as");
  for (const char* log : {"c.toml", "q.toml"})
    expect_one_line(shell(fmt::format("cd {}; {} campaign replay c.toml 0 --log {}", at, HIL_BENCH, log)),
                    "is the same file as");
  EXPECT_EQ(read(at + "/c.toml"), campaign);
  EXPECT_EQ(read(at + "/q.toml"), flown);
  EXPECT_FALSE(fs::exists(at + "/o.sqlite"));
}

TEST(CampaignBadInput, AReplayWhoseLogIsCutOffIsNoReplay) {
  const std::string log = folder("cut_log") + "/x.log";
  const Ended ended =
      shell(fmt::format("ulimit -f 16; {} campaign replay {} 0 --log {}", HIL_BENCH, campaign_file(), log));
  EXPECT_EQ(ended.code, 2) << ended.out;
  EXPECT_THAT(ended.err, testing::StartsWith("hil-bench: cannot write log '" + log + "': File too large"));
}

TEST(CampaignBadInput, ResultsThatAreAPipeOrAFolder) {
  const std::string at = folder("pipes");
  ASSERT_EQ(shell("mkfifo " + at + "/p.sqlite").code, 0);
  for (const std::string command : {"report p.sqlite", "merge m.db p.sqlite"})
    expect_one_line(shell(fmt::format("cd {}; timeout 10 {} campaign {}", at, HIL_BENCH, command)),
                    "p.sqlite: is a pipe, expected results of a campaign");
  expect_one_line(hil_bench("campaign report " + at), ": is a folder, expected results of a campaign");
  expect_one_line(hil_bench(fmt::format("campaign {} --resume --out {}/p.sqlite", campaign_file(), at)),
                  "is a pipe");
  expect_one_line(hil_bench("campaign report /no.sqlite"),
                  "/no.sqlite: cannot be read (No such file or directory), expected results of a campaign");
}

TEST(CampaignBadInput, WhatHasNoEffectOnAPaper) {
  for (const char* option : {"--shard 0/2", "--resume", "--threads 1", "--json x"})
    expect_one_line(hil_bench(fmt::format("campaign --paper wind {}", option)), "excludes");
}

TEST(CampaignBadInput, FullDiskLeavesWhatWasCommitted) {
  const std::string at = folder("full");
  // No file may exceed 100 KiB, so a write fails as on a full disk.
  const auto while_full = [&](const std::string& more) {
    return shell(
        fmt::format("ulimit -f 100; {} campaign {} --out {} {}", HIL_BENCH, campaign_file(), at, more));
  };
  const std::string full = "campaign30.sqlite: cannot be read or written: disk I/O error (File too large); ";
  expect_one_line(while_full(""), full);
  expect_one_line(while_full("--resume"), full);
  EXPECT_THAT(while_full("--resume").err, HasSubstr(" of 120 runs are kept, to be resumed\n"));
  expect_done(hil_bench(fmt::format("campaign {} --out {} --resume", campaign_file(), at)));
  EXPECT_TRUE(merged(at) == undisturbed());
}

// hil-bench campaign starts a separate program, which may not have been built.
TEST(CampaignBadInput, WithoutItsProgramIsOneLineThatSaysHowItIsMade) {
  const std::string alone = folder("alone") + "/hil-bench";
  fs::copy_file(HIL_BENCH, alone);
  expect_one_line(
      shell(fmt::format("{} campaign {}", alone, campaign_file())),
      "alone/hil-bench-campaign: No such file or directory, expected it beside hil-bench: cmake --build "
      "build/default --target hil-bench-campaign");
  EXPECT_THAT(shell(alone + " --help").out, testing::HasSubstr("campaign"));
}

TEST(CampaignBadInput, WithoutThePapersProgramIsOneLineThatSaysHowItIsMade) {
  const std::string alone = folder("no_papers") + "/hil-bench";
  for (const char* program : {"hil-bench", "hil-bench-campaign"})
    fs::copy_file(fs::path(HIL_BENCH).replace_filename(program), fs::path(alone).replace_filename(program));
  expect_one_line(
      shell(alone + " campaign --paper transfer"),
      "no_papers/hil-bench-paper: No such file or directory, expected it beside hil-bench: cmake --build "
      "build/default --target hil-bench-paper");
}

TEST(CampaignBadInput, ReadOnlyFolderIsOneLineAndLeavesWhatIsThere) {
  const std::string at = folder("read_only"), half = at + "/half.sqlite";
  expect_done(hil_bench(fmt::format("campaign {} --shard 0/2 --out {}", campaign_file(), half)));
  const std::string stored = read(half);
  fs::permissions(at, fs::perms{0555});
  fs::permissions(half, fs::perms{0444});
  // Root may ignore the modes of files. Without these two capabilities, root must respect them.
  const std::string bound_by_modes = without_capabilities("-dac_override,-dac_read_search") + HIL_BENCH;
  const auto campaign = [&](const std::string& out) {
    return shell(fmt::format("{} campaign {} --out {}", bound_by_modes, campaign_file(), out));
  };
  expect_one_line(campaign(at), "campaign30.sqlite': cannot be written: Permission denied");
  expect_one_line(campaign(half + " --resume"),
                  "half.sqlite: cannot be read or written: attempt to write a "
                  "readonly database; 60 of 120 runs are kept, to be resumed");
  fs::permissions(at, fs::perms{0755});
  EXPECT_EQ(std::distance(fs::directory_iterator(at), {}), 1);
  EXPECT_TRUE(read(half) == stored);
  fs::permissions(half, fs::perms{0644});
  expect_done(hil_bench(fmt::format("campaign {} --resume --out {}", campaign_file(), half)));
  EXPECT_TRUE(merged(at) == undisturbed());
}

}  // namespace
}  // namespace canhil::test
