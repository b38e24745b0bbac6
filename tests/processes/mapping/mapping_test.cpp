// Tests hil-bench with an ECU that has a DBC of its own, over a bus.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string folder = SOURCE_DIR "/docs/examples/own_ecu";
const std::string own_ecu = folder + "/own_ecu.toml";

std::string in_python(const std::string& defect) {
  return fmt::format("--target '/usr/bin/python3 {}/tests/processes/mapping/defective_ecu.py {}'", SOURCE_DIR,
                     defect);
}

Ended run(const std::string& target, const std::string& report, const std::string& more = "") {
  return hil_bench(fmt::format("run {} --bus {} {} --json {} {}", own_ecu, bus(), target, report, more));
}

// A run in real time. It is repeated if the host stalled for longer than two periods of the IMU samples,
// because the values of the ECU are then late.
Ended run_in_time(const std::string& target, const std::string& report, const std::string& more = "") {
  constexpr double two_samples_s = 0.02;
  Ended ended = run(target, report, more);
  for (int left = 3; left > 0 && ended.code != 2 && largest_lateness_s(read_json(report)) > two_samples_s;
       --left)
    ended = run(target, report, more);
  return ended;
}

// The names of the checks in a report that have this outcome.
std::vector<std::string> checks(const nlohmann::json& report, const std::string& outcome) {
  std::vector<std::string> names;
  for (const auto& check : report["checks"]) {
    if (check["outcome"] == outcome)
      names.push_back(check["kind"].get<std::string>() + " " + check["name"].get<std::string>());
  }
  return names;
}

class Ecu : public testing::TestWithParam<const char*> {};

TEST_P(Ecu, PassesInRealTime) {
  const std::string report = scratch("ecu.json");
  const Ended ended = run_in_time(GetParam(), report);
  ASSERT_NE(ended.code, 2) << ended.err;
  const nlohmann::json seen = read_json(report);
  expect_outputs_passed(ended, seen);
  EXPECT_GE(figure(seen, "own_ecu", "answers", "ECU_Attitude"), 1190) << ended.out;
}

TEST_P(Ecu, PassesInVirtualTime) {
  const std::string report = scratch("ecu.json");
  const Ended ended = run(GetParam(), report, "--lockstep");
  ASSERT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(checks(read_json(report), "fail"), testing::IsEmpty());
  EXPECT_EQ(figure(read_json(report), "own_ecu", "answers", "ECU_Attitude"), 1200);
}

const std::string python = "--target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/own_ecu/own_ecu.py'";
INSTANTIATE_TEST_SUITE_P(InPython, Ecu, testing::Values(python.c_str()));
INSTANTIATE_TEST_SUITE_P(InC, Ecu, testing::Values("--target " OWN_ECU_C));

struct Defect {
  const char* name;
  const char* caught_by;  // the check that must fail
  const char* clock;
};

class DefectiveEcu : public testing::TestWithParam<Defect> {};

TEST_P(DefectiveEcu, IsCaughtByTheCheckThatItIsFor) {
  const std::string report = scratch("defect.json");
  const Ended ended = run(in_python(GetParam().name), report, GetParam().clock);
  const nlohmann::json seen = read_json(report);
  EXPECT_NE(ended.code, 0) << ended.err << ended.out;
  const auto failed = checks(seen, "fail");
  if (!failed.empty() || std::string(GetParam().name) != "slow") {
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_THAT(failed, testing::Contains(HasSubstr(GetParam().caught_by))) << ended.out;
  } else {  // the host delayed the bench, so the bench could not judge the latency of the slow ECU
    EXPECT_THAT(checks(seen, "not measured"), testing::Contains(HasSubstr(GetParam().caught_by)))
        << ended.out;
    EXPECT_THAT(ended.out, testing::AnyOf(HasSubstr("this host kept the bench itself"),
                                          HasSubstr("no CPU was free for the bench"),
                                          HasSubstr("other programs kept the target waiting")))
        << ended.out;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, DefectiveEcu,
                         testing::Values(Defect{"wrong_sign", "error attitude.pitch", "--lockstep"},
                                         Defect{"stale", "delay attitude.roll", "--lockstep"},
                                         Defect{"wrong_checksum", "protection", ""},
                                         Defect{"frozen_counter", "protection", "--lockstep"},
                                         Defect{"slow", "latency ECU_Attitude", ""},
                                         Defect{"silent", "answers", ""}),
                         [](const auto& of) { return std::string(of.param.name); });

// The program defective_ecu.py passes if no defect is selected.
TEST(OwnEcu, WithoutADefectPasses) {
  const std::string report = scratch("none.json");
  EXPECT_EQ(run(in_python("none"), report, "--lockstep").code, 3);
  EXPECT_THAT(checks(read_json(report), "fail"), testing::IsEmpty());
}

TEST(OwnEcu, IsFlownByACampaign) {
  const std::string campaign = scratch("campaign.toml"), results = scratch("results");
  std::ofstream(campaign) << fmt::format(
      "title = \"own ECU\"\nruns = 3\nseed = 5\n[[variant]]\nname = \"as it is\"\nscenario = \"{}\"\n"
      "[[metric]]\nkind = \"distribution\"\nname = \"roll\"\nquantity = \"attitude.roll\"\nat_s = 11.0\n"
      "rms_at_most_mrad = 20.0\n",
      fs::relative(own_ecu, fs::path(campaign).parent_path()).string());
  const Ended ended = hil_bench(fmt::format("campaign {} {} --out {}", campaign, python, results));
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const Ended in_process = hil_bench(fmt::format("campaign {} --out {}2", campaign, results));
  EXPECT_EQ(in_process.code, 2);
  EXPECT_THAT(in_process.err, HasSubstr("expected a bus and --target")) << in_process.err;
}

// A run is recorded in a log; the IMU samples are extracted from the log with the mapping, and a second run
// sends these samples.
TEST(OwnEcu, ARecordedDriveIsDrivenAgain) {
  const std::string log = scratch("drive.log"), csv = scratch("imu.csv"), again = scratch("again.toml");
  ASSERT_NE(run_in_time(in_python("none"), scratch("drive.json"), "--log " + log).code, 2);
  const std::string extract = fmt::format("dbc extract {}/own_ecu.mapping.toml {}", folder, log);
  const Ended taken = hil_bench(extract + " --play IMU_TX3");
  ASSERT_EQ(taken.code, 0) << taken.err;
  EXPECT_TRUE(
      taken.out.starts_with("t_s,rate_z_radps,specific_force_y_mps2,rate_x_radps,specific_force_x_mps2,rate_"
                            "y_radps,specific_force_z_mps2\n"))
      << taken.out.substr(0, 200);
  EXPECT_EQ(std::count(taken.out.begin(), taken.out.end(), '\n'), 1201);
  std::ofstream(csv) << taken.out;
  const double first_s = std::stod(taken.out.substr(taken.out.find('\n') + 1));
  std::string text = read(own_ecu);
  const auto imu = text.find("[slave_imu]"), checks_at = text.find("[[check]]");
  text =
      text.substr(0, imu) +
      fmt::format("[slave_imu]\nperiod_ms = 10\nrecorded = \"imu.csv\"\nfrom_s = {:.6f}\n", first_s - 0.01) +
      text.substr(checks_at);
  std::ofstream(again) << text;
  for (const char* file : {"own_ecu.mapping.toml", "own_ecu.dbc"})
    fs::copy_file(folder + "/" + file, fs::path(again).parent_path() / file,
                  fs::copy_options::overwrite_existing);
  const Ended ended =
      hil_bench(fmt::format("run {} {} --lockstep --json {}", again, python, scratch("again.json")));
  ASSERT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(checks(read_json(scratch("again.json")), "fail"), testing::IsEmpty()) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("PASS          error attitude.roll"));
  expect_one_line(hil_bench(extract + " --play IMU_TX1"), "has no play 'IMU_TX1', expected one of: IMU_TX3");
  expect_one_line(
      hil_bench(fmt::format("dbc extract {}/own_ecu.mapping.toml /dev/null --play IMU_TX3", folder)),
      "has no whole group of IMU_TX3");
}

// Flies a scenario in which the bench sends values in CAN FD frames of 24 bytes with float signals, and the
// ECU sends the same values back.
Ended run_fd(const std::string& ecu) {
  const std::string dbc = scratch("fd.dbc"), mapping = scratch("fd.mapping.toml"), file = scratch("fd.toml");
  std::ofstream(dbc) << R"(VERSION ""
BU_: IMU ECU
BO_ 768 Rates: 24 IMU
 SG_ RateX : 0|64@1- (1,0) [0|0] "rad/s" ECU
 SG_ RateY : 64|64@1- (1,0) [0|0] "rad/s" ECU
 SG_ Count : 128|16@1+ (1,0) [0|0] "" ECU
BO_ 769 Echo: 24 ECU
 SG_ EchoX : 0|64@1- (1,0) [0|0] "rad/s" IMU
 SG_ EchoY : 64|64@1- (1,0) [0|0] "rad/s" IMU
 SG_ EchoCount : 128|16@1+ (1,0) [0|0] "" IMU
SIG_VALTYPE_ 768 RateX : 2;
SIG_VALTYPE_ 768 RateY : 2;
SIG_VALTYPE_ 769 EchoX : 2;
SIG_VALTYPE_ 769 EchoY : 2;
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","StandardCAN_FD";
BA_DEF_DEF_ "VFrameFormat" "StandardCAN";
BA_ "VFrameFormat" BO_ 768 2;
BA_ "VFrameFormat" BO_ 769 2;
)";
  std::ofstream(mapping) << fmt::format(R"(dbc = "{}"
[[play]]
messages = ["Rates"]
every_ms = 10
[play.signals]
"Rates.RateX" = "imu.rate.x"
"Rates.RateY" = "imu.rate.y"
[[hear]]
message = "Echo"
answers = "Rates"
echo = {{ signal = "EchoCount", of = "Rates.Count" }}
signals = {{ EchoX = "rate.x", EchoY = "rate.y" }}
[[protection]]
messages = ["Rates"]
counter = {{ signal = "Count" }}
)",
                                        fs::path(dbc).filename().string());
  std::string text = read(own_ecu);
  text = text.substr(0, text.find("[[check]]"));
  const auto at = text.find("own_ecu.mapping.toml");
  text.replace(at, std::string("own_ecu.mapping.toml").size(), fs::path(mapping).filename().string());
  std::ofstream(file)
      << text
      << "[[check]]\nkind = \"error\"\nquantity = \"rate.x\"\nstatistic = \"rms\"\nbelow_degps = 0.5\n"
      << "[[check]]\nkind = \"answers\"\nanswers_at_least = 1200\n";
  return hil_bench(fmt::format("run {} --target '{}' --lockstep", file, ecu));
}

TEST(OwnEcu, MayBeOnCanFd) {
  const Ended ended = run_fd(FD_ECU);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("CAN FD")) << ended.out;
}

TEST(OwnEcu, AnswersThatAreNoNumberAreCountedAndFail) {
  const Ended ended = run_fd(FD_ECU " nan");
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.out,
              testing::ContainsRegex("FAIL +error rate.x rms +12 of 1200 answers are not a number .NaN or "
                                     "infinite., first at 1 s"));
}

struct Edit {
  const char* file;
  std::string text, instead;
};

// Runs a copy of the example in which texts of its files are replaced.
class Altered : public testing::Test {
 protected:
  Altered() { start_again(); }
  void start_again() const {
    fs::remove_all(copy_);
    fs::copy(folder, copy_);
  }
  void change(const std::string& file, const std::string& text, const std::string& instead) const {
    edit(copy_ + "/" + file, text, instead);
  }
  [[nodiscard]] Ended run_altered(const std::string& target, const std::string& more = "--lockstep") const {
    return hil_bench(fmt::format("run {}/own_ecu.toml {} {}", copy_, target, more));
  }
  [[nodiscard]] Ended run_edited(const std::vector<Edit>& edits, const std::string& target,
                                 const std::string& more) const {
    start_again();
    for (const Edit& edit : edits) change(edit.file, edit.text, edit.instead);
    return run_altered(target, more);
  }
  [[nodiscard]] Ended run_with(const char* file, const std::string& text, const std::string& instead) const {
    return run_edited({{file, text, instead}}, python, "--lockstep");
  }
  // A run of 3 s in real time; returns its report.
  [[nodiscard]] nlohmann::json run_in_real_time(const std::string& target,
                                                std::vector<Edit> edits = {}) const {
    edits.push_back({"own_ecu.toml", "duration_s = 12.0", "duration_s = 3.0"});
    edits.push_back({"own_ecu.toml", "answers_at_least = 1190", "answers_at_least = 140"});
    const std::string report = scratch("edited.json");
    const Ended ended = run_edited(edits, target, "--json " + report);
    EXPECT_NE(ended.code, 2) << ended.err;
    return read_json(report);
  }
  void expect_refused(const char* file, const std::string& text, const std::string& instead,
                      const std::string& because) {
    expect_one_line(run_with(file, text, instead), because);
  }

 private:
  const std::string copy_ = scratch("altered");
};

TEST_F(Altered, AMappingThatIsWrongIsRefusedInOneLine) {
  const char* mapping = "own_ecu.mapping.toml";
  expect_refused(mapping, "dbc = \"own_ecu.dbc\"", "dbc = \"none.dbc\"", "none.dbc");
  expect_refused(mapping, "\"IMU_TX3\"]", "\"IMU_TX4\"]", "the DBC has no message 'IMU_TX4'");
  expect_refused(mapping, "TX1_YawRate\"", "TX1_Yaw\"",
                 "IMU_TX1 has no signal 'TX1_Yaw', expected one of: TX1_YawRate, TX1_AccY");
  expect_refused(mapping, "-imu.rate.z", "-imu.rate.w",
                 "'imu.rate.w' is not a quantity that a node measures");
  expect_refused(mapping, "-imu.rate.z", "imu.specific_force.z",
                 "is in '°/s', imu.specific_force.z is in m/s^2");
  expect_refused(mapping, "\"attitude.roll\"", "\"attitude.rol\"",
                 "'attitude.rol' is not a quantity that a target reports");
  expect_refused(mapping, "\"IMU_TX3.TX3_Counter\"", "\"ECU_Status.STS_State\"",
                 "is not part of the play that it answers");
  expect_refused(mapping, "CRC-8/SAE-J1850", "CRC-8/NOBODY", "CRC-8/NOBODY");
  expect_refused(mapping, "dbc = \"own_ecu.dbc\"", "dbc = \"own_ecu.dbc\"\nsigns = [\"excludes\"]",
                 "'excludes' is no flag of a [[hear]]");
  expect_refused(mapping, "counter = { signal = \"TX1_Counter\" }", "countr = 3", "countr");
  expect_refused("own_ecu.toml", "period_ms = 10", "period_ms = 3", "expected a whole fraction of it");
  expect_refused("own_ecu.toml", "handshake = \"none\"", "handshake = \"some\"", "handshake");
  expect_refused("own_ecu.toml", "quantity = \"attitude.roll\"", "quantity = \"velocity.north\"",
                 "'velocity.north' is unknown, expected one of: attitude.pitch, attitude.roll");
  expect_refused("own_ecu.toml", "settle_s", "before = \"false\"\nsettle_s",
                 "'false' exited with 1, expected 0");
}

std::string measured(const nlohmann::json& report, const std::string& name) {
  for (const auto& check : report["checks"]) {
    if (check["name"] == name)
      return fmt::format("{}: {}", check["outcome"].get<std::string>(), check["measured"].get<std::string>());
  }
  return "no such check";
}

// What a target with a mapping does not get must not look as if it had an effect.
TEST_F(Altered, WhatHasNoEffectIsRefused) {
  expect_refused("own_ecu.toml", "[slave_imu]", "[initial_error]\nattitude_deg = [1, 1, 1]\n[slave_imu]",
                 "key 'initial_error': has no effect: with a mapping, only the sensor [start] tells");
  expect_refused(
      "own_ecu.toml", "[slave_imu]", "[engagement]\nguidance = \"target\"\n[seeker]\n[slave_imu]",
      "key 'engagement.guidance': is 'target', but the mapping has no answers that guide the missile");
}

// The DBC of the mapping counts, and its messages are not those of single nodes.
TEST_F(Altered, WhatBelongsToCanhilsDbcIsRefused) {
  expect_refused("own_ecu.toml", "title =", "dbc = \"canhil-fd\"\ntitle =",
                 "key 'dbc': has no effect: the mapping names the DBC");
  for (const char* option : {"--dbc canhil-fd", "--bus-of slave_imu=local:own_ecu_imu"})
    EXPECT_EQ(hil_bench(fmt::format("run {} --lockstep {} {}", own_ecu, python, option)).code, 2) << option;
}

// The missile flies by the tracker's answers, so a tracker with a defect misses.
TEST(Tracker, GuidesTheMissile) {
  const std::string own = SOURCE_DIR "/tests/processes/mapping/tracker/";
  const auto flown = [&](const std::string& defect, const std::string& more) {
    return hil_bench(
        fmt::format("run {0}tracker.toml {1} --target '/usr/bin/python3 {0}tracker.py {2}' --json {3}", own,
                    more, defect, scratch("tracker.json")));
  };
  const auto miss_m = [] { return figure(read_json(scratch("tracker.json")), "tracker", "end", "miss"); };
  const Ended good = flown("none", "--lockstep");
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  EXPECT_LT(miss_m(), 1);
  for (const char* defect : {"zero", "mirrored", "late"}) {
    const Ended bad = flown(defect, "--lockstep");
    EXPECT_EQ(bad.code, 1) << defect << bad.err;
    EXPECT_THAT(checks(read_json(scratch("tracker.json")), "fail"),
                testing::Contains("miss_distance miss_distance"));
    EXPECT_GT(miss_m(), 5) << defect;
  }
  // In real time an answer that comes too late for its command is counted. On a host that is late, the
  // missile is guided late, and may miss or turn faster than the signals can say.
  Ended real = flown("none", "--bus " + bus());
  for (int left = 3; left > 0 && (real.code == 1 || real.code == 3); --left)
    real = flown("none", "--bus " + bus());
  EXPECT_EQ(real.code, 0) << real.out << real.err;
  EXPECT_LT(miss_m(), 5);
}

// The counter of the samples has 4 bits and comes round every 160 ms.
TEST_F(Altered, ATargetThatIsARoundLateIsNotOnTime) {
  const nlohmann::json report = run_in_real_time(in_python("round_late"));
  for (const char* check : {"latency ECU_Attitude", "error attitude.roll"})
    EXPECT_THAT(
        measured(report, check),
        testing::MatchesRegex("not measured: [0-9]+ of [0-9]+ answers in ECU_Attitude may belong to more "
                              "than one sample: ATT_ImuCounter comes round every 160 ms"));
  EXPECT_THAT(measured(report, "delay attitude.roll"), HasSubstr("fail"))
      << "the values prove that it is late";
}

// Without an echo, the causes are certain if every sample is answered, however late the host is.
TEST_F(Altered, WithoutAnEchoTheCausesMayBeCertain) {
  const Edit no_echo{"own_ecu.mapping.toml", "echo = {", "# echo = {"};
  const nlohmann::json each = run_in_real_time(in_python("none"), {no_echo});
  for (const char* check : {"error attitude.roll", "delay attitude.roll"})
    EXPECT_THAT(measured(each, check), testing::StartsWith("pass: ")) << each["checks"].dump(1);
  EXPECT_THAT(measured(each, "senders"), HasSubstr("no such check"));
  const nlohmann::json sparse = run_in_real_time(in_python("sparse"), {no_echo});
  for (const char* check : {"latency ECU_Attitude", "error attitude.roll"})
    EXPECT_THAT(measured(sparse, check), testing::AllOf(testing::StartsWith("not measured: "),
                                                        HasSubstr("it has no echo of the sample")));
}

TEST_F(Altered, ProtectionOfNothingIsNotMeasured) {
  const std::string counter = "counter = { signal = \"ATT_Counter\" }",
                    checksum = "checksum = { signal = \"ATT_CRC\", model = \"CRC-8/SAE-J1850\" }",
                    own = "[[protection]]\nmessages = [\"ECU_Attitude\"]\n" + counter + "\n" + checksum;
  const auto judged = [&](const std::vector<Edit>& edits) {
    const std::string report = scratch("protection.json");
    EXPECT_NE(run_edited(edits, python, "--lockstep --json " + report).code, 2);
    return measured(read_json(report), "protection");
  };
  const Edit unprotected{"own_ecu.mapping.toml", own, ""};
  EXPECT_EQ(judged({unprotected}), "not measured: no message that came has a counter or checksum");
  const Edit by_name{"own_ecu.toml", "kind = \"protection\"",
                     "kind = \"protection\"\nname = \"protection\"\nmessage = \"ECU_Status\""};
  EXPECT_EQ(judged({by_name}), "not measured: ECU_Status has no counter or checksum");
  const Edit no_counter{"own_ecu.mapping.toml", counter, ""},
      limit{"own_ecu.toml", "kind = \"protection\"", "kind = \"protection\"\nlost_at_most = 3"};
  EXPECT_EQ(judged({no_counter, limit}), "not measured: no message that came has a counter");
  EXPECT_EQ(judged({no_counter}), "pass: wrong checksums 0, wrong sizes 0") << "nothing is said of counters";
}

// A signal that cannot hold its value is a fault of the scenario.
TEST_F(Altered, AStimulusThatIsClippedNeverPasses) {
  expect_refused("own_ecu.toml", "roll_period_s = 3.0", "roll_period_s = 0.5",
                 "IMU_TX2.TX2_RollRate holds -163.84 to 163.83 \u00b0/s, its node measures ");
  const std::string report = scratch("clipped.json");
  const Ended ended = run_edited({{"own_ecu.toml", "[[check]]",
                                   "[[fault]]\nkind = \"bias\"\nquantity = \"imu.rate.x\"\n"
                                   "by_degps = 170\nfrom_s = 6\n[[check]]"}},
                                 python, "--lockstep --json " + report);
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(measured(read_json(report), "stimuli"),
              testing::StartsWith("not measured: IMU_TX2.TX2_RollRate holds"));
  EXPECT_THAT(measured(read_json(report), "error attitude.roll"), testing::StartsWith("not measured: "));
}

// The counters and checksums of the DBC are spoilt as those of canhil's own messages are.
TEST_F(Altered, FaultsSpoilTheProtectionOfTheDbc) {
  const auto answers = [&](const std::string& fault, const char* target = "none") {
    const std::string report = scratch("spoilt.json");
    const Ended ended = run_edited({{"own_ecu.toml", "[[check]]", "[[fault]]\n" + fault + "\n[[check]]"}},
                                   in_python(target), "--lockstep --json " + report);
    EXPECT_NE(ended.code, 2) << ended.err;
    return figure(read_json(report), "own_ecu", "answers", "ECU_Attitude");
  };
  EXPECT_EQ(answers("kind = \"wrong_crc\"\nmessages = [\"IMU_TX1\"]\nevery = 10"), 1080);
  EXPECT_EQ(answers("kind = \"counter_jump\"\nby = 1\nmessages = [\"IMU_TX1\"]\nevery = 10"), 1080);
  // The counter of every tenth frame comes round after eight such frames.
  EXPECT_EQ(answers("kind = \"counter_stuck\"\nmessages = [\"IMU_TX1\"]\nevery = 10"), 1080 + 120 / 8);
  EXPECT_EQ(answers("kind = \"counter_stuck\"\nmessages = [\"IMU_TX1\"]\nevery = 10", "redundant"), 1200)
      << "its checksums are right";
  const Edit no_counter{"own_ecu.mapping.toml", "counter = { signal = \"TX1_Counter\" }\n", ""},
      no_checksum{"own_ecu.mapping.toml",
                  "checksum = { signal = \"TX1_CRC\", model = \"CRC-8/SAE-J1850\" }\n", ""};
  for (const auto& [kind, edit, because] :
       {std::tuple("wrong_crc", no_checksum, "IMU_TX1 has no checksum, expected messages that have one"),
        std::tuple("counter_stuck", no_counter, "IMU_TX1 has no counter, expected messages that have one")}) {
    const std::string fault =
        fmt::format("[[fault]]\nkind = \"{}\"\nmessages = [\"IMU_TX1\"]\n[[check]]", kind);
    expect_one_line(run_edited({edit, {"own_ecu.toml", "[[check]]", fault}}, python, "--lockstep"), because);
  }
}

// A target may answer a sample of which a frame was lost: for example, it takes the frame of a redundant
// sensor.
TEST_F(Altered, ASampleThatCameInPartMayBeAnswered) {
  const std::string report = scratch("redundant.json");
  const Ended ended = run_edited({{"own_ecu.toml", "[[check]]",
                                   "[[fault]]\nkind = \"lost\"\nmessages = [\"IMU_TX1\"]\nevery = 50\n"
                                   "from_s = 1\nto_s = 11\n[[check]]"}},
                                 in_python("redundant"), "--lockstep --json " + report);
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(checks(read_json(report), "fail"), testing::IsEmpty()) << ended.out;
  EXPECT_EQ(figure(read_json(report), "own_ecu", "answers", "ECU_Attitude"), 1200);
}

// A message without a quantity, for example of a network management, is sent at its own times.
TEST_F(Altered, AMessageOfConstantsIsSent) {
  const std::string log = scratch("constants.log");
  const Ended ended = run_edited({{"own_ecu.dbc", "BO_ 512 ECU_Attitude",
                                   "BO_ 1281 NM: 2 IMU\n SG_ Node : 0|8@1+ (1,0) [0|255] \"\" ECU\n SG_ Wake "
                                   ": 8|8@1+ (1,0) [0|255] \"\" "
                                   "ECU\n\nBO_ 512 ECU_Attitude"},
                                  {"own_ecu.mapping.toml", "# The answer of the ECU.",
                                   "[[play]]\nmessages = [\"NM\"]\nevery_ms = "
                                   "200\n[play.signals]\n\"NM.Node\" = 17\n\"NM.Wake\" = 1\n#"}},
                                 python, "--lockstep --log " + log);
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  const std::string text = read(log);
  int sent = 0;
  for (std::size_t at = text.find("501#1101"); at != std::string::npos; at = text.find("501#1101", at + 1))
    ++sent;
  EXPECT_EQ(sent, 60);
}

// Without a truth, the checks that need it are not measured; the timing and the counts still are.
TEST_F(Altered, WithoutATruthErrorsAreNotMeasured) {
  const std::string imu = scratch("imu.csv"), report = scratch("unknown.json");
  std::ofstream samples(imu);
  samples << "t_s,rate_x_radps,rate_y_radps,rate_z_radps,specific_force_x_mps2,specific_force_y_mps2,"
             "specific_force_z_mps2\n";
  for (int i = 0; i <= 1200; ++i) samples << fmt::format("{:.2f},0.1,0,0,0,0,-9.8\n", 0.01 * i);
  samples.close();
  const std::string own = read(folder + "/own_ecu.toml");
  const std::size_t truth = own.find("[truth]"), check = own.find("[[check]]");
  const std::string instead = fmt::format(
      "[truth]\ntrajectory = \"unknown\"\nlatitude_deg = 37.0\nlongitude_deg = 127.0\nheight_m = 100.0\n"
      "heading_deg = 30.0\n\n[slave_imu]\nrecorded = \"{}\"\n\n",
      imu);
  const Ended ended = run_edited({{"own_ecu.toml", own.substr(truth, check - truth), instead}}, python,
                                 "--lockstep --json " + report);
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  for (const char* error : {"error attitude.roll", "error attitude.pitch", "delay attitude.roll"})
    EXPECT_EQ(measured(read_json(report), error), "not measured: no truth: trajectory is \"unknown\"");
  EXPECT_THAT(measured(read_json(report), "answers answers"), testing::StartsWith("pass: "));
  EXPECT_THAT(ended.out, testing::Not(testing::ContainsRegex("nan|max 0\\.000")));
}

TEST_F(Altered, FaultsAffectWhatIsPlayed) {
  for (const char* message : {"IMU_TX1", "IMU_TX3"}) {
    const Ended ended = run_with(
        "own_ecu.toml", "[[check]]",
        fmt::format("[[fault]]\nkind = \"damaged\"\nmessages = [\"{}\"]\nevery = 10\n[[check]]", message));
    EXPECT_EQ(ended.code, 1) << ended.err << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("answers 1080  (expected answers >= 1190"))
        << "the ECU drops what is damaged";
  }
  expect_refused("own_ecu.toml", "[[check]]",
                 "[[fault]]\nkind = \"lost\"\nmessages = [\"ECU_Attitude\"]\n[[check]]",
                 "'ECU_Attitude' is unknown, expected one of: IMU_TX1, IMU_TX2, IMU_TX3");
  expect_refused(
      "own_ecu.toml", "[[check]]",
      "[[fault]]\nkind = \"changed\"\nsignal = \"x\"\nvalue = 1\nmessages = [\"IMU_TX1\"]\n[[check]]",
      "'changed' is for canhil's own messages");
}

TEST_F(Altered, WhatAMappingLeavesOutIsListed) {
  const Ended fine = hil_bench(fmt::format("dbc check {}/own_ecu.mapping.toml", folder));
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_THAT(fine.out, HasSubstr("note unheard: ECU_Status.STS_State is not used by the bench"));
  EXPECT_THAT(fine.out, HasSubstr("3 messages played, 2 heard, 2 quantities reported; bus load"));
  static_cast<void>(
      run_with("own_ecu.mapping.toml", "\"IMU_TX1.TX1_AccY\" = \"-imu.specific_force.y\"", "#"));
  const Ended ended = hil_bench(fmt::format("dbc check {}/own_ecu.mapping.toml", scratch("altered")));
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("warning unmapped: IMU_TX1.TX1_AccY no value is mapped to it"));
  static_cast<void>(run_with("own_ecu.mapping.toml", "[play.signals]", "every_ms = 20\n[play.signals]"));
  const Ended slow = hil_bench(fmt::format("dbc check {}/own_ecu.mapping.toml --json", scratch("altered")));
  EXPECT_EQ(slow.code, 1);
  EXPECT_EQ(json_of(slow.out)[0]["rule"], "cycle-time") << slow.out;
  expect_one_line(hil_bench("dbc check " + own_ecu), "own_ecu.toml");
}

// The heading weaves about south, where it passes from 180 to -180 deg; the ECU is 400 ms late.
TEST_F(Altered, ADelayIsMeasuredAcrossSouth) {
  change("own_ecu.mapping.toml", "attitude.roll", "attitude.heading");
  change("own_ecu.toml", "heading_deg = 30.0\nheading_amplitude_deg = 0",
         "heading_deg = 180\nheading_amplitude_deg = 20");
  change("own_ecu.toml", "roll_amplitude_deg = 15.0", "roll_amplitude_deg = 0");
  change("own_ecu.toml", "pitch_amplitude_deg = 6.0", "pitch_amplitude_deg = 0");
  for (int k = 0; k < 2; ++k) change("own_ecu.toml", "attitude.roll", "attitude.heading");
  const Ended ended = run_altered(in_python("late_heading"));
  EXPECT_THAT(ended.out, testing::ContainsRegex("FAIL +delay attitude.heading +(399|400)\\.[0-9] \\+- "))
      << ended.err;
}

TEST_F(Altered, ADelayThatCannotBeMeasuredSaysWhy) {
  const auto why = [&](const std::string& ecu) {
    const Ended ended = run_altered(in_python(ecu));
    const auto at = ended.out.find("not measured  delay attitude.roll");
    return at == std::string::npos ? ended.out + ended.err
                                   : ended.out.substr(at, ended.out.find('\n', at) - at);
  };
  EXPECT_THAT(why("zero"), HasSubstr("the answers do not follow the truth"));
  change("own_ecu.toml", "roll_amplitude_deg = 15.0", "roll_amplitude_deg = 0");
  change("own_ecu.toml", "pitch_amplitude_deg = 6.0", "pitch_amplitude_deg = 0");
  EXPECT_THAT(why("none"), HasSubstr("the truth is constant"));
}

TEST_F(Altered, VirtualTimeNeedsAnswersThatSayWhatTheyAnswer) {
  expect_refused("own_ecu.mapping.toml", "echo = {", "#", "virtual time would not know when to go on");
}

// The process joins the bus long after the settling time, and its only message is the answer to a sample.
TEST_F(Altered, ATargetThatStartsSlowlyIsAwaited) {
  const std::string slow = scratch("slow_ecu.sh"), report = scratch("slow_ecu.json");
  std::ofstream(slow) << "#!/bin/sh\nsleep 1\nexec /usr/bin/python3 " SOURCE_DIR
                         "/tests/processes/mapping/defective_ecu.py answers_only \"$@\"\n";
  ASSERT_EQ(shell("chmod +x " + slow).code, 0);
  const Edit short_wait{"own_ecu.toml", "settle_s = 0.3", "settle_s = 0.01"};
  const std::string status = "[[hear]]\nmessage = \"ECU_Status\"\n";
  const Edit answers_only{"own_ecu.mapping.toml", status, ""};
  const std::string own = read(folder + "/own_ecu.toml");
  const std::size_t of_status = own.find("[[check]]\nkind = \"output_period\""),
                    next = own.find("[[check]]\nkind = \"protection\"");
  const Edit checks_of_answers{"own_ecu.toml", own.substr(of_status, next - of_status), ""};
  const Ended ended = run_edited({short_wait, answers_only, checks_of_answers}, "--target " + slow,
                                 fmt::format("--lockstep --bus {} --json {}", bus(), report));
  EXPECT_EQ(ended.code, 3) << ended.err << ended.out;
  EXPECT_THAT(checks(read_json(report), "fail"), testing::IsEmpty()) << ended.out;
  // The status of this ECU comes only after the first sample: so it is silent until the run begins.
  const Ended silent = run_edited({short_wait}, in_python("status_after_sample"), "--json " + report);
  EXPECT_NE(silent.code, 2) << silent.err;
  EXPECT_EQ(read_json(report)["ending"]["completed"], true) << silent.out;
}

TEST(OwnEcu, ThatIsNotThereIsNamed) {
  const Ended ended = hil_bench(fmt::format("run {} --target none --bus local:{}", own_ecu,
                                            fs::path(scratch("x")).parent_path().filename().string()));
  expect_one_line(ended, "none of ECU_Status within 5 s; nothing was received");
}

}  // namespace
}  // namespace canhil::test
