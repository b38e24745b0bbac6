// What candump shows on the screen, and what may be between the lines of its log.
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(CandumpScreen, IsRead) {
  EXPECT_THAT(
      read_log(" (1436509052.249713)  vcan0  123   [8]  05 00 00 00 00 00 00 01   '........'\n"
               " (1436509052.259713)  vcan0  00000124  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B\n"
               " (1436509052.259813)  vcan0  125  [02]  00 01\n"
               " (1436509052.269713)  vcan0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME\n"
               " (1436509052.279713)  vcan0  125   [3]  remote request\n"
               " (1436509052.279813)  vcan0  126   {B}  01 02 03 04 05 06 07 08\n"
               " (1436509052.289713)  can1  TX B E  127  [01]  05\n"
               " (1436509052.289714)  can1  RX - -  128   [0] \n"
               " (1436509052.289714123)  can1  128   [0] \n")
          .lines,
      ElementsAre("(1436509052.249713) vcan0 123#0500000000000001 R",
                  "(1436509052.259713) vcan0 00000124##4000102030405060708090A0B R",
                  "(1436509052.259813) vcan0 125##40001 R",
                  "(1436509052.269713) vcan0 20000004#0004000000000000 R",
                  "(1436509052.279713) vcan0 125#R3 R", "(1436509052.279813) vcan0 126#0102030405060708 R",
                  "(1436509052.289713) can1 127##705 T", "(1436509052.289714) can1 128# R",
                  "(1436509052.289714) can1 128# R"));
}

// Options -i (binary digits), -S (bytes from the last to the first), -c and -cc (colours).
TEST(CandumpScreen, OfOtherViewsIsRead) {
  EXPECT_THAT(read_log(" (1436509052.249713)  can0  123   [2]  00000101 11111111\n"
                       " (1436509052.249713)  can0  123   [3]  03`02`01   '.'\n"
                       " (1436509052.249713)  can0  123   [2]  00000110`00000101\n"
                       " (1436509052.249713)  can0  123   [1]  05\n"
                       " (1436509052.249713)  \x1b[31mcan0  123   [2]  05 06\x1b[0m\n"
                       " \x1b[1m\x1b[34m(1436509052.249713)  can0  123   [2]  05 07\x1b[0m\n")
                  .lines,
              ElementsAre("(1436509052.249713) can0 123#05FF R", "(1436509052.249713) can0 123#010203 R",
                          "(1436509052.249713) can0 123#0506 R", "(1436509052.249713) can0 123#05 R",
                          "(1436509052.249713) can0 123#0506 R", "(1436509052.249713) can0 123#0507 R"));
  EXPECT_THAT(read_log(" (1436509052.249713)  can0  123   [2]  20 23   ' #'\n").lines,
              ElementsAre("(1436509052.249713) can0 123#2023 R"));
  EXPECT_EQ(read_log(" (1436509052.249713)  can0  123   [3]  02`01\n").error,
            "log:1: expected 3 bytes of data");
}

TEST(CandumpScreen, TimesCountFromTheFirstFrame) {
  const auto read = read_log(
      " (000.000000)  vcan0  123   [1]  05\n (000.500000)  vcan0  123   [1]  06\n"
      " (001.700000)  vcan0  123   [1]  07\n");
  EXPECT_THAT(read.lines, ElementsAre("(0.000000) vcan0 123#05 R", "(0.500000) vcan0 123#06 R",
                                      "(1.700000) vcan0 123#07 R"));
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("since the first frame (candump -t z)")));
}

TEST(CandumpScreen, TimesCountFromThePreviousFrame) {
  const auto read = read_log(
      " (000.000000)  vcan0  123   [1]  05\n (001.500000)  vcan0  123   [1]  06\n"
      " (000.700000)  vcan0  123   [1]  07\n");
  EXPECT_THAT(read.lines, ElementsAre("(0.000000) vcan0 123#05 R", "(1.500000) vcan0 123#06 R",
                                      "(2.200000) vcan0 123#07 R"));
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("since the previous frame (candump -t d)")));
  const auto regular =
      read_log(" (000.000000)  c  123   [0] \n (000.100000)  c  123   [0] \n (000.100000)  c  123   [0] \n");
  EXPECT_EQ(regular.lines.back(), "(0.200000) c 123# R");
}

// The difference of two dates does not depend on the time zone.
TEST(CandumpScreen, DatesAreLocalTimes) {
  const auto read = read_log(
      " (2015-07-10 08:10:52.249713)  vcan0  123   [1]  05\n"
      " (2015-07-10 08:12:53.249714)  vcan0  123   [1]  05\n");
  ASSERT_EQ(read.entries.size(), 2U);
  EXPECT_EQ(read.entries[1].t_ns - read.entries[0].t_ns, 121'000'001'000);
  EXPECT_NEAR(static_cast<double>(read.entries[0].t_ns), 1436515852.249713e9, 14 * 3600e9);
}

TEST(CandumpScreen, WhatIsWrongIsSaid) {
  for (const auto& [line, what] :
       {std::pair(" (1.000000)  c  123   [9]  05", "expected a size of a frame"),
        {" (1.000000)  c  123   [2]  05", "expected 2 bytes of data"},
        {" (1.000000)  c  123   [1]  0G", "expected a byte in place of '0G'"},
        {" (1.000000)  c  800   [0] ", "expected an id"},
        {" (2015-13-10 08:10:52.249713)  c  123   [0] ", "expected the time of candump"}})
    EXPECT_THAT(read_log(std::string(line) + "\n").error, testing::StartsWith(std::string("log:1: ") + what))
        << line;
}

TEST(Candump, LinesThatAreNoFramesAreCounted) {
  const auto read = read_log(
      "# engine off\n\n(1.000000) can0 123#05\n# on\n(1.100000) can0 00321#81:05:11223344#DEADBEEF\n"
      "\tcontroller-problem{}\n(1.200000) can0 123#R_9\n(1.300000) can0 123#11.22.33_B\n");
  EXPECT_THAT(read.lines, ElementsAre("(1.000000) can0 123#05 R", "(1.200000) can0 123#R R",
                                      "(1.300000) can0 123#112233 R"));
  EXPECT_THAT(read.remarks,
              ElementsAre("log 'log': 3 left out: lines that are not frames, such as comments; the first is "
                          "log:1: '# engine off'",
                          "log 'log': 1 left out: frames of CAN XL; the first is log:5: '(1.100000) can0 "
                          "00321#81:05:11223344#DEADBEEF'"));
  EXPECT_THAT(read_log("  can0  123   [1]  05\n").remarks, ElementsAre(HasSubstr("frames without a time")));
}

TEST(Candump, RemoteFramesAreLeftOutUnlessAskedFor) {
  const auto read = read_log("(1.000000) can0 123#R8\n(1.100000) can0 123#05\n", RemoteFrames::left_out);
  EXPECT_THAT(read.lines, ElementsAre("(1.100000) can0 123#05 R"));
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("1 left out: remote frames; the first is log:1:")));
}

}  // namespace
}  // namespace canhil
