// Tests bad input: the program must print one line (what, where, what was expected), end with exit code 2,
// and write no partial output.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "dbc/ports/local_bus.hpp"
#include "dbc/wire/transmit.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

TEST(BadInput, UnknownBus) {
  expect_one_line(hil_bench(fmt::format("run {} --bus nocan7", scenario("transfer_alignment_quick"))),
                  "nocan7");
  expect_one_line(hil_target("--bus nocan7"), "nocan7");
}

TEST(BadInput, NobodyHostsTheBus) {
  expect_one_line(hil_target("--bus local:nobody-here"), "nobody hosts it");
}

TEST(BadInput, MissingScenario) { expect_one_line(hil_bench("run no_such.toml"), "no_such.toml"); }

TEST(BadInput, ScheduleOfWhatIsNoDbc) {
  expect_one_line(hil_bench("schedulability no_such.dbc"),
                  "no_such.dbc: cannot be read (No such file or directory), expected a DBC file");
  const std::string fd = TEST_DATA_DIR "/dbc/fd.dbc";
  expect_one_line(hil_bench("schedulability " + fd), fd + ": no bit rate, expected --bitrate");
  expect_one_line(hil_bench("schedulability --bitrate 500000 " + fd), "message Long is CAN FD");
  expect_one_line(hil_bench("schedulability --bitrate 5e5 " + fd), "--bitrate: '5e5' is not a whole number");
  expect_one_line(hil_bench("schedulability --error-burst 2 " + fd), "--errors-per-second");
  for (const std::string number : {"nan", "inf", "-1", "0", "1x"}) {
    expect_one_line(hil_bench(fmt::format("schedulability --errors-per-second={} {}", number, fd)),
                    fmt::format("--errors-per-second: '{}' is not a number from 1e-06 to 100000", number));
    expect_one_line(hil_bench(fmt::format("schedulability --event-interval-ms={} {}", number, fd)),
                    fmt::format("--event-interval-ms: '{}' is not a number from 0.001 to 1e+09", number));
  }
  expect_one_line(hil_bench("schedulability /dev/zero"), "/dev/zero: is larger than 16 MiB");
  expect_one_line(hil_bench("run /dev/zero"), "/dev/zero: is larger than 1 MiB");
  expect_one_line(hil_bench("report /dev/zero"), "/dev/zero: is larger than 64 MiB");
  expect_one_line(hil_target("--bus local:nobody --dbc /dev/zero"), "/dev/zero: is larger than 16 MiB");
  expect_one_line(hil_target("--replay /dev/zero"), "/dev/zero:1: is longer than 4096 characters");
}

TEST(BadInput, UnknownScenarioKey) {
  std::ofstream(scratch("typo.toml"))
      << read(scenario("transfer_alignment_quick")) << "\n[slave_inu]\nperiod_ms = 10\n";
  expect_one_line(hil_bench("run " + scratch("typo.toml")), "slave_inu");
}

std::string edited(const std::string& file, std::string_view from, std::string_view to) {
  std::string text = read(scenario("transfer_alignment_quick"));
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, from.size(), to);
  std::ofstream(scratch(file)) << text;
  return scratch(file);
}

TEST(BadInput, ParameterThatTheTargetRefusesIsNamedWithItsPlace) {
  const std::string file =
      edited("range.toml", "[target.parameters]\n", "[target.parameters]\nh2_case = 7\n");
  expect_one_line(
      hil_bench(fmt::format("run {} --bus {}", file, bus())),
      file +
          ":13: key 'target.parameters.h2_case': 7 was sent and refused by the target: out_of_range, "
          "expected a whole number from 1 to 4; 2 stays in force");
}

TEST(BadInput, AMisspeltParameterIsOneOfItsEstimator) {
  // Of the parameters of all estimators, gyro_bias_sigma_degph has the nearest name, but the wind estimator
  // does not have this parameter.
  std::string text = read(scenario("wind_quick"));
  const std::string table = "[target.parameters]\n";
  const auto at = text.find(table);
  if (at == std::string::npos) {
    text += "\n" + table + "gyro_rate_sigma_degph = 1\n";
  } else {
    text.insert(at + table.size(), "gyro_rate_sigma_degph = 1\n");
  }
  std::ofstream(scratch("misspelt.toml")) << text;
  expect_one_line(
      hil_bench(fmt::format("run {} --bus in-process", scratch("misspelt.toml"))),
      "key 'target.parameters.gyro_rate_sigma_degph': is unknown, expected 'glider_rate_sigma_degps'");
}

TEST(BadInput, ValueThatTheBusCannotCarry) {
  expect_one_line(hil_bench("run " + edited("fine.toml", "heading_deg = 5.0", "heading_deg = 0.001")),
                  "initial value 0.001 deg does not fit into TargetInitSigma.heading_sigma_deg");
  expect_one_line(hil_bench("run " + edited("fast.toml", "speed_kmph = 500.0", "speed_kmph = 9000.0")),
                  "TargetInitVelocityNE.velocity_north_mps, expected -1677 to 1677");
  expect_one_line(hil_bench("run " + edited("slow.toml", "[slave_imu]", "[slave_imu]\nperiod_ms = 50")),
                  "IMU interval 50000 us does not fit into SlaveImuStatus.interval_us");
  expect_one_line(
      hil_bench("run " + edited("astray.toml", "gyro_bias_sigma_degph = 3", "gyro_bias_sigma_degph = 1e9")),
      "'slave_imu.gyro_bias_sigma_degph' (largest part): an IMU increment of up to 290.888 rad does not fit");
}

TEST(BadInput, AnEngagementThatCannotBeFlown) {
  const auto with = [](std::string_view from, std::string_view to) {
    std::string text = read(scenario("los_closed_loop"));
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    std::ofstream(scratch("los.toml")) << text.replace(at, from.size(), to);
    return hil_bench("run " + scratch("los.toml"));
  };
  expect_one_line(with("manoeuvre = \"step\"", "manoeuvre = \"stop\""),
                  "key 'engagement.manoeuvre': 'stop' is unknown, expected 'step'");
  expect_one_line(with("guidance_delay_ms = 10.0", "guidance_delay_ms = 1.0"),
                  "key 'engagement.guidance_delay_ms': 1 is less than the bus takes in lockstep, expected at "
                  "least 10, the cycle of Sync");
  expect_one_line(with("period_ms = 5\nthermal", "period_ms = 4.005\nthermal"),
                  "seeker interval 4005 us does not fit into SeekerAngles.interval_us");
  expect_one_line(with("[seeker]", "[gps]\n[seeker]"),
                  "key 'gps': depends on a truth, expected a table [truth] beside it");
}

TEST(BadInput, UnknownOption) {
  expect_one_line(hil_bench("run --colour x.toml"),
                  "option '--colour' is unknown; see hil-bench run --help\n");
  expect_one_line(hil_bench("run x.toml --jsn=y"),
                  "option '--jsn' is unknown, expected '--json'; see hil-bench run");
  expect_one_line(hil_bench("campaign x.toml --ouy y"),
                  "option '--ouy' is unknown, expected '--out'; see hil-bench "
                  "campaign --help\n");
  expect_one_line(hil_bench("check x.log y.toml z.toml"), "z.toml; see hil-bench check --help\n");
  expect_one_line(hil_target("--bus x --speed 3"), "--speed");
  expect_one_line(hil_target(""), "--bus");
}

TEST(BadInput, AValueThatIsEmpty) {
  for (const char* option : {"--dbc", "--json", "--target", "--bus", "--html"})
    expect_one_line(hil_bench(fmt::format("run {} {} ''", scenario("transfer_alignment_quick"), option)),
                    fmt::format("{}: is empty, expected a value; see hil-bench run --help\n", option));
  expect_one_line(hil_bench("run ''"), "SCENARIO: is empty");
  expect_one_line(hil_bench("campaign merge ''"), "is empty");
  expect_one_line(hil_target("--bus local:x --dbc ''"), "--dbc: is empty");
}

TEST(BadInput, DbcgenWithoutAFile) {
  expect_one_line(shell(DBCGEN), "dbcgen: dbc is required; see dbcgen --help\n");
  expect_one_line(shell(DBCGEN " --colour"), "dbcgen: ");
  EXPECT_EQ(shell(DBCGEN " --help").code, 0);
}

TEST(BadInput, QueuesOfPriorityInLockstep) {
  const std::string run =
      fmt::format("run {} --bus 'local:?bitrate=1000000", scenario("transfer_alignment_quick"));
  expect_one_line(hil_bench(run + "&queue=priority' --lockstep"),
                  "--lockstep: with the queues of --bus 'local:?");
}

TEST(BadInput, LatencyOfAMessageThatNobodySends) {
  const std::string file = edited("nobody.toml", "kind = \"latency\"\nmessage = \"AlignAttitude\"",
                                  "kind = \"latency\"\nmessage = \"WindUpdate\"");
  expect_one_line(hil_bench("run " + file),
                  "'WindUpdate' is sent by wind, which is not run in this scenario, "
                  "expected a message of transfer_alignment");
}

TEST(Run, BusErrorsAreJudgedWhereTheBusReportsThem) {
  const std::string file =
      edited("bus_errors.toml", "[[check]]", "[[check]]\nkind = \"bus_errors\"\n\n[[check]]");
  const auto outcome = [&](const std::string& bus) {
    const std::string report = scratch("bus_errors.json");
    hil_bench(fmt::format("run {} --bus '{}' --json {}", file, bus, report));
    return read_json(report)["checks"][0]["outcome"].get<std::string>();
  };
  EXPECT_EQ(outcome("in-process"), "not measured");
  EXPECT_EQ(outcome("in-process?bitrate=500000"), "pass");
}

TEST(BadInput, UnknownSubcommand) {
  expect_one_line(hil_bench("runn x.toml"), "hil-bench: subcommand 'runn' is unknown, expected 'run'");
  expect_one_line(
      hil_bench("zebra"),
      "subcommand 'zebra' is unknown, expected one of: run, new, report, compare, bus, accept, campaign, "
      "faults, reference, diverge, golden, doctor, schedulability");
  expect_one_line(hil_bench(""), "subcommand is required");
}

TEST(BadInput, ALogThatIsAFolder) {
  const std::string folder = testing::TempDir();
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process --log {}",
                                        scenario("transfer_alignment_quick"), folder)),
                  folder);
}

TEST(BadInput, NumberThatIsNone) {
  const auto run = [](const std::string& number) {
    return hil_bench(fmt::format("run {} --bus in-process {}", scenario("transfer_alignment_quick"), number));
  };
  expect_one_line(run("--seed ''"), "--seed");
  for (const char* number : {"-1", "18446744073709551616", "1e3", "0x10", "1.5", "seven"}) {
    expect_one_line(run(fmt::format("--seed {}", number)), "--seed");
    expect_one_line(run(fmt::format("--seed={}", number)),
                    "is not a whole number from 0 to 18446744073709551615");
  }
  EXPECT_EQ(run("--seed 18446744073709551615").code, 3);
  EXPECT_EQ(run("--seed 010 --json " + scratch("ten.json")).code, 3);
  EXPECT_EQ(read_json(scratch("ten.json"))["provenance"]["seed"], 10);
}

TEST(Outputs, ADashIsStandardOutputInPlaceOfTheText) {
  const std::string run = fmt::format("run {} --bus in-process ", scenario("transfer_alignment_quick"));
  const Ended json = hil_bench(run + "--json -");
  EXPECT_EQ(json.code, 3) << json.err;
  EXPECT_EQ(json_of(json.out)["provenance"]["bus"], "in-process");
  const Ended junit = hil_bench(run + "--junit - --json " + scratch("beside.json"));
  EXPECT_TRUE(junit.out.starts_with("<?xml")) << junit.out;
  EXPECT_TRUE(junit.out.ends_with("</testsuites>\n")) << junit.out;
  EXPECT_EQ(read_json(scratch("beside.json"))["checks"].size(), json_of(json.out)["checks"].size());
  expect_one_line(hil_bench(run + "--json - --junit -"), "--json -, --junit -: both to standard output");
  expect_one_line(hil_bench(run + "--log -"), "--log -: standard output cannot hold this");
  EXPECT_FALSE(std::filesystem::exists("-"));
  const Ended full = shell(fmt::format("{} {} --junit - >/dev/full", HIL_BENCH, run));
  expect_one_line(full, "standard output: cannot be written: No space left on device");
}

std::string version_of(const Ended& ended) {
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
  return ended.out.substr(ended.out.find(' '));
}

TEST(Version, NamesTheProjectAndTheContract) {
  const std::string bench = version_of(hil_bench("--version"));
  EXPECT_THAT(bench, testing::StartsWith(fmt::format(" {} (revision ", PROJECT_VERSION)));
  EXPECT_THAT(bench, testing::EndsWith(fmt::format(") · DBC {:016x}, on the bus {:06x}\n", messages::dbc_hash,
                                                   messages::exchange_hash24())));
  EXPECT_EQ(version_of(hil_target("--version")), bench);
  const std::string revision = bench.substr(0, bench.find(" ·"));
  EXPECT_EQ(version_of(shell(DBCGEN " --version")), revision + "\n");
  const auto reported = json_of(hil_bench(fmt::format("run {} --bus {} --lockstep --json -",
                                                      scenario("transfer_alignment_quick"), bus()))
                                    .out)["provenance"];
  EXPECT_THAT(revision, testing::StartsWith(fmt::format(" {} (", reported["version"].get<std::string>())));
  EXPECT_THAT(revision, testing::HasSubstr("revision " + reported["revision"].get<std::string>() + ")"));
  EXPECT_THAT(reported["version"].get<std::string>(),
              testing::StartsWith(reported["target"]["version"].get<std::string>() + "."))
      << "the version that heartbeats carry";
}

TEST(Scripts, TellTheirUseAndRefuseWhatTheyDoNotKnow) {
  for (const char* script : {"bench/demo.sh", "tests/run.sh"}) {
    const std::string command = fmt::format("bash {}/{} ", SOURCE_DIR, script);
    const Ended help = shell(command + "--help");
    EXPECT_EQ(help.code, 0) << help.err;
    EXPECT_TRUE(help.out.starts_with("Builds")) << help.out;
    EXPECT_EQ(help.out.find('#'), std::string::npos) << help.out;
    expect_one_line(shell(command + "--colour"), "unknown option '--colour': expected");
  }
  const auto refused = [](const std::string& options, const std::string& what) {
    expect_one_line(shell(fmt::format("bash {}/tests/run.sh {}", SOURCE_DIR, options)), what);
  };
  refused("--only", "--only: expected a regular");
  refused("--full --coverage", "--coverage excludes --full");
  refused("--coverage --tidy", "--coverage excludes --tidy");
}

TEST(BadInput, ReportThatCannotBeWrittenIsRejectedBeforeTheRun) {
  expect_one_line(
      hil_bench(fmt::format("run {} --json /no/such/folder/x.json", scenario("transfer_alignment_quick"))),
      "/no/such/folder/x.json");
}

TEST(BadInput, FilesThatWouldReplaceSomethingElse) {
  const std::string quick = scenario("transfer_alignment_quick");
  ASSERT_EQ(shell("mkfifo " + scratch("pipe")).code, 0);
  expect_one_line(hil_bench(fmt::format("run {} --junit {}", quick, scratch("pipe"))),
                  "is not a regular file");
  ASSERT_EQ(shell(fmt::format("cp {} {}", quick, scratch("self.toml"))).code, 0);
  expect_one_line(hil_bench(fmt::format("run {0} --log {0}", scratch("self.toml"))), "is the same file as");
  EXPECT_EQ(read(scratch("self.toml")), read(quick));
}

// A second bench or target is rejected without disturbing the current run.
TEST(BadInput, ASecondBenchOrTargetOnABus) {
  const std::string long_flight =
      scratch("long.toml");  // still on its way after both others, on a busy machine
  ASSERT_EQ(shell(fmt::format("cp {} {}", scenario("transfer_alignment_quick"), long_flight)).code, 0);
  edit(long_flight, "duration_s = 3.0", "duration_s = 8.0");
  const std::string report = scratch("first.json");
  // Waits for the first run to begin: it then removes the report of an earlier one.
  std::ofstream(report) << "of an earlier run";
  const Ended second = shell(
      fmt::format("{0} run {1} --bus local:shared --json {2} >{3} & first=$!; "
                  "while [ -e {2} ] && kill -0 $first; do sleep 0.05; done; "
                  "{4} --bus local:shared; echo $? >{5}; "
                  "{0} run {1} --bus local:shared --target none; code=$?; wait $first; exit $code",
                  HIL_BENCH, long_flight, report, scratch("first.out"), HIL_TARGET, scratch("target.code")));
  EXPECT_EQ(second.code, 2) << second.out << second.err;
  EXPECT_EQ(read(scratch("target.code")), "2\n");
  EXPECT_THAT(second.err, HasSubstr("a target answers here already"));
  EXPECT_THAT(second.err, HasSubstr("another bench runs on this bus"));
  EXPECT_TRUE(read_json(report)["ending"]["completed"]);
  EXPECT_EQ(read_json(report)["from_target"]["frames_lost"], 0);
}

TEST(BadInput, LogThatIsNoLog) {
  std::ofstream(scratch("broken.log")) << "(1.000000) can0 0A0#00\nnonsense\n";
  const Ended ended = hil_target("--replay " + scratch("broken.log"));
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, testing::HasSubstr("broken.log:2:")) << "the line is left out, and said to be";
}

TEST(BadInput, LogWithoutFrames) {
  std::ofstream(scratch("empty.log")).flush();
  expect_one_line(hil_target("--replay " + scratch("empty.log")), "empty.log: holds no frames");
}

TEST(BadInput, AlgorithmOfAnotherEstimatorIsNamedWithItsPlace) {
  const std::string file = edited("other.toml", "algorithm = \"kalman\"", "algorithm = \"ukf\"");
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", file)), file + ":");
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", file)),
                  "key 'target.algorithm': the target on 'in-process' does not offer 'ukf' for "
                  "'transfer_alignment', expected one of: kalman, robust_h2; its errors: command");
}

TEST(BadInput, WholeNumberParameterThatIsNone) {
  const std::string file =
      edited("half.toml", "[target.parameters]\n", "[target.parameters]\nh2_case = 2.5\n");
  expect_one_line(hil_bench(fmt::format("run {} --bus in-process", file)),
                  "2.5 was sent and refused by the target: out_of_range");
}

TEST(BadInput, BusMisspelt) {
  const std::string run = fmt::format("run {} --bus ", scenario("transfer_alignment_quick"));
  expect_one_line(hil_bench(run + "inprocess"), "there is no such interface, expected 'in-process'");
  expect_one_line(hil_bench(run + "local"), "there is no such interface, expected 'local:'");
  expect_one_line(hil_bench(run + "in-process --target /bin/false"), "--target: with --bus in-process");
}

TEST(BadInput, SettingsOfAWire) {
  for (const std::string bus : {"in-process", "local:"}) {
    const auto run = [&](const std::string& settings) {
      return hil_bench(
          fmt::format("run {} --bus '{}?{}'", scenario("transfer_alignment_quick"), bus, settings));
    };
    expect_one_line(run("bitrate=500000&bit-error-rate=2"),
                    "'bit-error-rate=2' is not understood, expected bitrate=1000..1000000");
    expect_one_line(run("bit-error-rate=1e-6"), "expected bitrate=1000..1000000 after '?'");
  }
  expect_one_line(hil_bench(fmt::format("run {} --bus 'in-process?bitrate=500000' --target /bin/false",
                                        scenario("transfer_alignment_quick"))),
                  "--target: with --bus in-process");
}

TEST(BadInput, ARunThatDoesNotBeginLosesNothingAndLeavesNothing) {
  const std::filesystem::path folder = scratch("not_begun");
  std::filesystem::create_directories(folder);
  const std::vector<std::string> names{"a.log", "a.json", "a.xml", "a.html"};
  for (const std::string& name : names) std::ofstream(folder / name) << "of an earlier run";
  const Ended ended = hil_bench(fmt::format(
      "run {0} --bus {1} --target /bin/false --log {2}/a.log --json {2}/a.json --junit {2}/a.xml --html "
      "{2}/a.html",
      scenario("transfer_alignment_quick"), bus(), folder.string()));
  EXPECT_EQ(ended.code, 2);
  for (const std::string& name : names) EXPECT_EQ(read(folder / name), "of an earlier run") << name;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 4) << "nothing unfinished stays";
}

// A run that is killed writes no report. A report of an earlier run must not remain in the file either.
TEST(BadInput, ARunThatBeganLeavesNoReportOfAnEarlierOne) {
  const std::string report = scratch("stale.json");
  std::ofstream(report) << "of an earlier run";
  // Waits for the run to begin, however slow the machine is, and kills it then. A run that leaves the report
  // goes on to its end.
  shell(
      fmt::format("{} run {} --bus {} --json {} & "
                  "while [ -e {} ] && kill -0 $!; do sleep 0.05; done; kill -KILL $!; wait",
                  HIL_BENCH, scenario("transfer_alignment_quick"), bus(), report, report));
  EXPECT_FALSE(std::filesystem::exists(report));
}

// A target that was built from another DBC. The test takes the place of this target: it hosts the bus and
// sends heartbeats with another hash.
TEST(BadInput, TargetBuiltFromAnotherDbc) {
  const std::string bus = "local:other-dbc";
  auto hub = host_local_bus(bus, {});
  ASSERT_TRUE(hub) << hub.error().message;
  std::atomic<bool> stop = false;
  std::thread other_target([&] {
    Outbox<1> out;
    while (!stop) {
      out.clear();
      out.send(messages::TargetHeartbeat{.dbc_hash = messages::exchange_hash24() ^ 0xFFU});
      static_cast<void>((*hub)->send(out.frames().front()));
      for (int i = 0; i < 10; ++i) {
        while ((*hub)->receive()) {
        }
        wait(**hub, WaitFor::frame, clock_ns(CLOCK_MONOTONIC) + 5'000'000);
      }
    }
  });
  const Ended ended =
      hil_bench(fmt::format("run {} --bus {} --target none", scenario("transfer_alignment_quick"), bus));
  stop = true;
  other_target.join();
  expect_one_line(ended, "target and bench are built from different DBC files");
}

}  // namespace
}  // namespace canhil::test
