// Tests hil-bench decode as a user starts it: what it prints on stdout and stderr, and what it writes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string file(const std::string& name, const std::string& text) {
  std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

std::string digits_dbc() {
  return file("digits.dbc",
              "BU_: A\nBO_ 100 M: 8 A\n SG_ t_us : 0|56@1+ (1,0) [0|0] \"us\" A\n"
              "BO_ 101 P: 8 A\n SG_ lat : 0|64@1- (1,0) [0|0] \"deg\" A\nSIG_VALTYPE_ 101 lat : 2;\n");
}

TEST(DecodeProgram, WritesAllDigits) {
  const std::string log =
      file("digits.log", "(1.000000) can0 064#406ABFE7E6120600\n(2.000000) can0 065#7BA39B6ECD0F4840\n");
  EXPECT_EQ(hil_bench(fmt::format("decode {} --dbc {} --format csv", log, digits_dbc())).out,
            "t_s,bus,M.t_us,P.lat\n0.000000,can0,1709632800123456,\n1.000000,can0,,48.123456789012344\n");
  EXPECT_EQ(hil_bench(fmt::format("decode {} --dbc {}", log, digits_dbc())).out,
            "    0.000000  can0 R M: t_us=1709632800123456 us\n    1.000000  can0 R P: "
            "lat=48.123456789012344 deg\n");
}

TEST(DecodeProgram, SaysWhatIsMissing) {
  const std::string log = file("short.log", "(1.000000) can0 065#7BA39B6ECD0F48\n(2.000000) can0 066#00\n");
  const Ended ended = hil_bench(fmt::format("decode {} --dbc {}", log, digits_dbc()));
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, "    0.000000  can0 R P: lat=missing\n");
  EXPECT_EQ(ended.err,
            "hil-bench: 1 frame left out, of no message: 066\n"
            "hil-bench: 1 frame shorter than the message, 1 signal missing\n");
}

TEST(DecodeProgram, FindsJ1939ByGroup) {
  const std::string dbc =
      file("group.dbc",
           "BU_: A\nBO_ 2566844926 CCVS1: 8 A\n SG_ Speed : 8|16@1+ (0.00390625,0) [0|0] \"km/h\" A\n"
           "BO_ 2566848515 Of3: 8 A\nBO_ 2566848516 Of4: 8 A\n");
  const std::string log =
      file("group.log", "(1.000000) can0 18FEF100#FF0010FFFFFFFFFF\n(2.000000) can0 18FF0005#00\n");
  const std::string command = fmt::format("decode {} --dbc {}", log, dbc);
  EXPECT_EQ(hil_bench(command).out, "");
  const Ended ended = hil_bench(command + " --j1939");
  EXPECT_EQ(ended.out, "    0.000000  can0 R from 0 CCVS1: Speed=16 km/h\n");
  EXPECT_EQ(ended.err,
            "hil-bench: 1 frame left out, whose parameter group the DBC has only for several other sources: "
            "18FF0005\n");
  expect_one_line(hil_bench(fmt::format("decode {} --dbc {} --j1939", log, digits_dbc())),
                  "--j1939: the DBC has no message with a 29-bit id");
}

TEST(DecodeProgram, SaysThatTheDbcHasWarnings) {
  const std::string dbc = file("odd.dbc", "BU_: A\nBO_ 100 M: 8 B\n SG_ s : 0|8@1+ (1,0) [0|0] \"\x81\" A\n");
  const std::string log = file("odd.log", "(1.000000) can0 064#05\n");
  const Ended ended = hil_bench(fmt::format("decode {} --dbc {}", log, dbc));
  EXPECT_EQ(ended.out, "    0.000000  can0 R M: s=5 \xEF\xBF\xBD\n");
  EXPECT_THAT(ended.err,
              HasSubstr("odd.dbc: 2 warnings, which 'hil-bench dbc lint' lists; the first: line 3: the "
                        "text is neither UTF-8 nor Windows-1252"));
  EXPECT_EQ(hil_bench(fmt::format("decode {} --dbc {} --encoding cp437", log, dbc)).out,
            "    0.000000  can0 R M: s=5 \xC3\xBC\n");
  expect_one_line(hil_bench(fmt::format("decode {} --dbc {} --encoding nonsense", log, dbc)),
                  "--encoding 'nonsense': expected the name of an encoding");
}

TEST(DecodeProgram, LeavesAFileAsItWasIfTheLogIsBad) {
  const std::string log = file("bad.log", "(1.000000) can0 064#05\n(2.000000) can0 nonsense\n");
  const std::string out = file("kept.csv", "mine\n");
  for (const char* format : {"csv", "text"}) {
    expect_one_line(
        hil_bench(fmt::format("decode {} --dbc {} --format {} --out {}", log, digits_dbc(), format, out)),
        "bad.log:2");
    EXPECT_EQ(read(out), "mine\n");
  }
}

}  // namespace
}  // namespace canhil::test
