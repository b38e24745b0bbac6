// What tools other than canhil write into ASC logs.
#include <fmt/format.h>

#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string asc_head = "base hex  timestamps absolute\n";

std::vector<std::string> lines_of_events(const std::string& events) {
  return read_log(asc_head + events).lines;
}

// The flags of a CANFD event state whether the frame is one of CAN FD (0x1000) or a remote frame (0x10).
TEST(Asc, ReadsClassicFramesInEventsOfCanFd) {
  const std::string tail = "   242136  125   {}      dbc 46500250 460a0250 20011736 20010205\n";
  const auto event = [&](const char* text, const char* flags) {
    return text + fmt::format(fmt::runtime(tail), flags);
  };
  EXPECT_THAT(
      lines_of_events(
          event("0.1 CANFD   1 Rx        123  Name_1      0 0 8  8 05 00 00 00 00 00 00 01", "200000") +
          event("0.2 CANFD   2 Tx        124              0 0 8  0", "200010") +
          event("0.3 CANFD   1 Rx        125              1 1 2  2 05 06", "307000") +
          event("0.4 CANFD   1 Rx        126x             0 0 0  0", "201000")),
      ElementsAre("(0.100000) can0 123#0500000000000001 R", "(0.200000) can1 124#R8 T",
                  "(0.300000) can0 125##70506 R", "(0.400000) can0 00000126##4 R"));
}

TEST(Asc, NameOfAFrameOfCanFdMayHaveBlanks) {
  EXPECT_THAT(
      lines_of_events("0.1 CANFD 1 Rx 123 \"Engine 1 Data\" 1 0 9 12 00 01 02 03 04 05 06 07 08 09 0A 0B\n"
                      "0.2 CANFD 1 Rx 123 Engine Data 1 1 1 1 05\n"),
      ElementsAre("(0.100000) can0 123##5000102030405060708090A0B R", "(0.200000) can0 123##705 R"));
}

TEST(Asc, ReadsTheColumnsOfOldTools) {
  EXPECT_THAT(
      lines_of_events(
          "0.02 CANFD 1  101             Tx   1 0 d 9 12 F1 F1 F1 F1 F1 F1 F1 F1 F1 F1 F1 F2  Length = 2\n"
          "0.03 CANFD 2  102x  Name      Rx   0 1 d 1 1 0A  Length = 209000 BitCount = 128 ID = 258x\n"),
      ElementsAre("(0.020000) can0 101##5F1F1F1F1F1F1F1F1F1F1F1F2 T", "(0.030000) can1 00000102##60A R"));
}

TEST(Asc, ReadsRemoteFrames) {
  EXPECT_THAT(
      lines_of_events("0.1 1  123 Rx r\n0.2 1  123x Tx r 8\n0.3 1 123 Rx r Length = 0 BitCount = 4\n"),
      ElementsAre("(0.100000) can0 123#R R", "(0.200000) can0 00000123#R8 T", "(0.300000) can0 123#R R"));
}

TEST(Asc, ReadsFramesOfCanFdOfOldVersionsOfPythonCan) {
  EXPECT_THAT(lines_of_events("0.1 1  123x Rx d 10 00 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F\n"),
              ElementsAre("(0.100000) can0 00000123##4000102030405060708090A0B0C0D0E0F R"));
}

TEST(Asc, ReadsADecimalComma) {
  EXPECT_THAT(lines_of_events("0,040000 1  123 Rx d 1 05\n"), ElementsAre("(0.040000) can0 123#05 R"));
}

TEST(Asc, NeedsNoHeader) {
  EXPECT_THAT(read_log("   0.040000 1  123 Rx d 1 05\n").lines, ElementsAre("(0.040000) can0 123#05 R"));
}

TEST(Asc, CountsWhatItDoesNotRead) {
  const auto read =
      read_log(asc_head +
               "0.0 Start of measurement\n0.1 1 123 Rx d 1 05\n0.2 CANXL 1 Rx XLFF 984438\n"
               "0.3 CANXL 1 Rx XLFF 984439\n0.4 1 Statistic: D 0 R 0\n0.5 Li1 12 Rx 1 00\n"
               "0.6 1 EngineData Rx d 1 00\n0.7 1 123 TxRq d 1 00\nnonsense\nEnd TriggerBlock\n");
  EXPECT_THAT(read.error, IsEmpty());
  EXPECT_EQ(read.lines.size(), 1U);
  EXPECT_THAT(
      read.remarks,
      ElementsAre("log 'log': 2 left out: frames of CAN XL; the first is log:4: '0.2 CANXL 1 Rx XLFF 984438'",
                  HasSubstr("1 left out: bus statistics; the first is log:6:"),
                  HasSubstr("1 left out: events other than frames of CAN; the first is log:7:"),
                  HasSubstr("1 left out: frames with a name in place of the id; the first is log:8:"),
                  HasSubstr("1 left out: requests to send (TxRq); the first is log:9:"),
                  HasSubstr("1 left out: lines that are not events; the first is log:10:")));
}

std::int64_t time_of_date(const std::string& date) {
  const auto read = read_log("date " + date + "\n" + asc_head + "1.500000 1  123 Rx d 1 05\n");
  EXPECT_THAT(read.remarks, IsEmpty()) << date;
  return read.entries.empty() ? -1 : read.entries[0].t_ns;
}

TEST(Asc, ReadsDatesInOtherLanguages) {
  const std::int64_t october = time_of_date("Fri Oct 12 11:21:07 2007");
  for (const char* date :
       {"Fre Okt 12 11:21:07 2007", "ven. oct. 12 11:21:07 2007", "12.10.2007 11:21:07",
        "ven ott 12 11:21:07.000 2007", "vie oct 12 11:21:07 2007", "2007-10-12 11:21:07",
        "Fri Oct 12 11:21:07 am 2007", "sex out 12 11:21:07 2007", "Fr 12 Okt 2007 11:21:07"})
    EXPECT_EQ(time_of_date(date), october) << date;
  const std::int64_t march = time_of_date("Tue Mar 20 23:21:07.250 2007");
  for (const char* date : {"mar. mars 20 23:21:07.250 2007", "Die M\xE4r 20 23:21:07.250 2007",
                           "Di M\xC3\xA4rz 20 11:21:07.250 pm 2007", "mar mar 20 23:21:07,250 2007"})
    EXPECT_EQ(time_of_date(date), march) << date;
}

TEST(Asc, SaysThatADateIsNotUnderstood) {
  const auto read =
      read_log("date \xE9\x87\x91 10\xE6\x9C\x88 12 11:21:07 2007\n" + asc_head + "1.5 1  123 Rx d 1 05\n");
  ASSERT_EQ(read.lines.size(), 1U);
  EXPECT_EQ(read.entries[0].t_ns, 1'500'000'000);
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("dates that are not understood")));
}

TEST(Asc, KeepsTheErrorStateIndicatorAndRemoteFramesThroughTheWriter) {
  const std::string line = "0.1 CANFD   1 Rx        125   1 1 2  2 05 06   0 0 7000 0 0 0 0 0\n";
  EXPECT_THAT(read_log(asc_head + line).lines, ElementsAre("(0.100000) can0 125##70506 R"));
}

TEST(NotALog, IsRefused) {
  for (const char* text :
       {"// a note of somebody\nint main() { return 0; }\n", "Dear reader,\nhello\n", "; a comment\nhello\n"})
    EXPECT_THAT(read_log(text).error, HasSubstr("'log': is not a log")) << text;
}

}  // namespace
}  // namespace canhil
