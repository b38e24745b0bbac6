// Tests hil-bench dbc as a user starts it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A DBC of another maker, in which dbc lint finds two warnings and a note.
std::string odd_file() {
  std::string path = scratch("odd file.dbc");
  std::ofstream(path) << "BU_: A\nBO_ 291 Motion: 2 C\n SG_ speed : 0|12@1+ (0.5,0) [0|0] \"km/h\" A\n"
                         " SG_ beyond : 12|8@1+ (1,0) [0|0] \"\" A\nCM_ \"\xB0\";\n";
  return path;
}

std::string refused_file() {
  std::string path = scratch("refused.dbc");
  std::ofstream(path) << "A page\nof prose.\n";
  return path;
}

constexpr const char* canhil_dbc = SOURCE_DIR "/dbc/canhil.dbc";
constexpr const char* multiplexed_dbc = TEST_DATA_DIR "/dbc/multiplexed.dbc";

TEST(DbcLint, ListsFindingsByLineWithWhatFollows) {
  const std::string file = odd_file();
  const Ended ended = hil_bench(fmt::format("dbc lint '{}'", file));
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(
      ended.out,
      fmt::format("{0}:2:19: warning undeclared-node: no node 'C', expected one listed in BU_; the name "
                  "is kept, a section about the node is left out\n"
                  "{0}:4:6: warning signal-beyond-message: signal Motion.beyond reaches beyond the "
                  "message, expected all 8 bits inside of its 2 bytes; the signal is left out\n"
                  "{0}:5:6: note windows-1252: the text is not UTF-8, expected UTF-8; it is read as "
                  "Windows-1252\n"
                  "{0}: 1 message, 1 signal, 2 warnings, 1 note\n",
                  file));
}

TEST(DbcLint, ExitCodeSaysWhetherEveryFileIsTaken) {
  EXPECT_EQ(hil_bench(fmt::format("dbc lint --strict {} {}", canhil_dbc, multiplexed_dbc)).code, 0);
  EXPECT_EQ(hil_bench(fmt::format("dbc lint --strict {} '{}'", canhil_dbc, odd_file())).code, 1);
  const Ended refused = hil_bench(fmt::format("dbc lint {} '{}'", refused_file(), odd_file()));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.out, HasSubstr("error not-a-dbc: no section of a DBC file, expected one such as BO_; "
                                     "the file is refused\n"));
  EXPECT_THAT(refused.out, HasSubstr("refused.dbc: refused, 1 error\n"));
  // The next file is checked too.
  EXPECT_THAT(refused.out, HasSubstr("1 message, 1 signal, 2 warnings, 1 note\n"));
}

TEST(DbcLint, WritesJson) {
  const Ended ended = hil_bench(fmt::format("dbc lint --json '{}' {}", odd_file(), refused_file()));
  EXPECT_EQ(ended.code, 1);
  const nlohmann::json page = json_of(ended.out);
  ASSERT_EQ(page["files"].size(), 2U);
  EXPECT_EQ(page["files"][0]["loads"], true);
  EXPECT_EQ(page["files"][0]["signals"], 1);
  const nlohmann::json& finding = page["files"][0]["findings"][1];
  EXPECT_EQ(finding["line"], 4);
  EXPECT_EQ(finding["column"], 6);
  EXPECT_EQ(finding["severity"], "warning");
  EXPECT_EQ(finding["rule"], "signal-beyond-message");
  EXPECT_EQ(finding["consequence"], "the signal is left out");
  EXPECT_EQ(page["files"][1]["loads"], false);
}

TEST(DbcLint, WritesSarif) {
  const std::string path = scratch("lint.sarif");
  const Ended ended = hil_bench(fmt::format("dbc lint --sarif '{}' '{}'", path, odd_file()));
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, HasSubstr("undeclared-node"));  // the text report is printed too
  const nlohmann::json log = read_json(path);
  EXPECT_EQ(log["version"], "2.1.0");
  const nlohmann::json& run = log["runs"][0];
  ASSERT_EQ(run["results"].size(), 3U);
  const nlohmann::json& result = run["results"][1];
  EXPECT_EQ(result["ruleId"], "signal-beyond-message");
  EXPECT_EQ(result["level"], "warning");
  EXPECT_EQ(run["results"][2]["level"], "note");
  EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
  const nlohmann::json& place = result["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["region"]["startLine"], 4);
  EXPECT_EQ(place["region"]["startColumn"], 6);
  EXPECT_THAT(place["artifactLocation"]["uri"].get<std::string>(), StartsWith("file:///"));
  EXPECT_THAT(place["artifactLocation"]["uri"].get<std::string>(), HasSubstr("odd%20file.dbc"));
  // With `-`, standard output contains only the SARIF log.
  const Ended alone = hil_bench(fmt::format("dbc lint --sarif - '{}'", odd_file()));
  EXPECT_EQ(json_of(alone.out), log);
}

TEST(DbcLint, BadInputIsOneLine) {
  expect_one_line(hil_bench("dbc"), "A subcommand is required");
  expect_one_line(hil_bench("dbc lint"), "FILE is required");
  expect_one_line(hil_bench("dbc lint /nowhere.dbc"), "/nowhere.dbc: cannot be read");
  // If the second file cannot be read, the findings of the first are not printed.
  expect_one_line(hil_bench(fmt::format("dbc lint '{}' /nowhere.dbc", odd_file())),
                  "/nowhere.dbc: cannot be read");
  expect_one_line(hil_bench(fmt::format("dbc lint --json --sarif - {}", canhil_dbc)), "expected one of them");
  expect_one_line(hil_bench(fmt::format("dbc lint --sarif /nowhere/x {}", canhil_dbc)), "cannot be written");
  expect_one_line(hil_bench(fmt::format("dbc lint --sarif {0} {0}", refused_file())),
                  "is the same file as FILE");
}

TEST(DbcShow, ListsTheMessages) {
  const Ended ended = hil_bench(fmt::format("dbc show {}", multiplexed_dbc));
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out,
            "id          message   bytes  cycle  sender  signals\n"
            "0x12C       Simple    8      -      Sender  page always voltage current name mode\n"
            "0x00000160  Extended  8      -      Sender  top inner leaf_a leaf_b other rest\n");
  EXPECT_THAT(hil_bench(fmt::format("dbc show {}", canhil_dbc)).out,
              HasSubstr("0x080  SlaveImuDeltaTheta        8      10 ms    SlaveImu"));
}

TEST(DbcShow, DrawsTheLayoutOfAMessage) {
  const Ended ended = hil_bench(fmt::format("dbc show {} Extended", multiplexed_dbc));
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, StartsWith("0x00000160 Extended, 8 bytes, cycle -, sender Sender\n"));
  EXPECT_THAT(ended.out, HasSubstr("byte  bit 7  6     5    4    3    2    1    0\n"
                                   "0     A3     A2    A1   A0   .    .    .    .\n"
                                   "1     B7+    B6+   B5+  B4+  B3+  B2+  B1+  B0+\n"));
  EXPECT_THAT(
      ended.out,
      HasSubstr("C  leaf_a  23     12      Motorola  signed    0.5    0       -1000..1000  -     inner is "
                "0..3, 5       -\n"));
  EXPECT_EQ(hil_bench(fmt::format("dbc show {} 0x00000160", multiplexed_dbc)).out, ended.out);
  EXPECT_EQ(hil_bench(fmt::format("dbc show {} 352", multiplexed_dbc)).out, ended.out);
  EXPECT_THAT(
      hil_bench(fmt::format("dbc show {} SlaveImuDeltaTheta", canhil_dbc)).out,
      HasSubstr("rad   always        -\nF  gyro_validity      63     1       Intel  unsigned  1      0       "
                "0..1           -     always        1=valid, 0=invalid\n"));
}

TEST(DbcShow, WritesJson) {
  const Ended all = hil_bench(fmt::format("dbc show --json {}", multiplexed_dbc));
  const Ended one = hil_bench(fmt::format("dbc show --json {} Simple", multiplexed_dbc));
  EXPECT_EQ(json_of(one.out)["name"], "Simple");
  EXPECT_EQ(json_of(all.out)["messages"][0], json_of(one.out));
}

TEST(DbcShow, SaysThatThereAreWarnings) {
  const std::string file = odd_file();
  const Ended ended = hil_bench(fmt::format("dbc show '{}' Motion", file));
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, fmt::format("hil-bench: {}: 2 warnings, which 'hil-bench dbc lint' lists; the first: "
                                   "line 2: no node 'C', expected one "
                                   "listed in BU_\n",
                                   file));
  EXPECT_THAT(ended.out, HasSubstr("\nA  speed"));
  EXPECT_THAT(ended.out, Not(HasSubstr("beyond")));
}

TEST(DbcShow, ReadsTheEncodingThatIsGiven) {
  const std::string path = scratch("japanese.dbc");
  std::ofstream(path) << "BU_: A\nBO_ 291 M: 2 A\n SG_ s : 0|12@1+ (1,0) [0|0] \"\x94\x5C\" A\n";
  EXPECT_THAT(hil_bench(fmt::format("dbc show {} M --encoding shift_jis", path)).out,
              HasSubstr("\xE8\x83\xBD"));
  EXPECT_THAT(hil_bench(fmt::format("dbc lint {} --encoding shift_jis", path)).out,
              HasSubstr("1 message, 1 signal\n"));
  EXPECT_EQ(hil_bench(fmt::format("dbc show {} M", path)).code, 0);
  for (const char* command : {"show", "lint"})
    expect_one_line(hil_bench(fmt::format("dbc {} {} --encoding nonsense", command, path)),
                    "--encoding 'nonsense': expected the name of an encoding");
}

TEST(DbcShow, BadInputIsOneLine) {
  expect_one_line(hil_bench("dbc show"), "FILE is required");
  expect_one_line(
      hil_bench(fmt::format("dbc show {} Nobody", multiplexed_dbc)),
      "multiplexed.dbc: no message 'Nobody', expected the name or the id of one of the 2 messages");
  expect_one_line(hil_bench(fmt::format("dbc show {} 0xZ", multiplexed_dbc)), "no message '0xZ'");
  expect_one_line(hil_bench(fmt::format("dbc show {}", refused_file())),
                  "refused.dbc:1:1: no section of a DBC file, expected one such as BO_");
  expect_one_line(hil_bench("dbc show " SOURCE_DIR "/README.md"), "README.md:1:1: no section of a DBC file");
}

// A name in a DBC must not send escape sequences to the terminal.
TEST(DbcShow, PrintsNoControlCharacters) {
  const std::string path = scratch("escape.dbc");
  std::ofstream(path) << "BU_: A\nBO_ 291 M: 2 A\n SG_ s : 0|12@1+ (1,0) [0|0] \"\x1B[31m\" A\n"
                         "CM_ BO_ 291 \"a\nb\x1B[2J\";\nVAL_ 291 s 1 \"x\ny\x1B\" ;\nCM_ BU_ \x1B \"x\";\n";
  for (const char* command : {"lint", "show"}) {
    const Ended ended = hil_bench(fmt::format("dbc {} {}{}", command, path, command[0] == 's' ? " M" : ""));
    EXPECT_EQ(ended.out.find('\x1B'), std::string::npos) << ended.out;
    EXPECT_EQ(ended.code, 0);
  }
}

TEST(DbcRules, StandInTheDocumentation) {
  const Ended ended = hil_bench("dbc rules");
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(read(SOURCE_DIR "/docs/dbc.md"), HasSubstr(ended.out));
}

}  // namespace
}  // namespace canhil::test
