// Traces of PEAK. The lines have the forms that PEAK's document about the format shows.
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using test::read_log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Lines of candump without time and interface.
std::vector<std::string> frames_of(const test::ReadLog& read) {
  EXPECT_THAT(read.error, IsEmpty());
  std::vector<std::string> frames;
  for (const std::string& line : read.lines) frames.push_back(line.substr(line.find(") ") + 2));
  return frames;
}

TEST(Trc, OfVersion10IsRead) {
  const auto read = read_log(
      ";###\n;   C:\\TraceFile.trc\n;    Start time: 11.09.2002 16:00:20.682\n;----+-\n"
      "     1)      1841      0001  8  00 01 02 03 04 05 06 07\n     2)      1842      0008  4  ERROR 00 19 "
      "08 08\n"
      "     3)      1843  FFFFFFFF  4  00 00 00 04 -- -- -- --  BUSLIGHT\n     4)      1844      0100  3  "
      "RTR\n"
      "     5)      1845  18EFC034  1  05\n");
  EXPECT_THAT(frames_of(read), ElementsAre("can0 001#0001020304050607 R", "can0 20000080#0000000000000000 R",
                                           "can0 100#R3 R", "can0 18EFC034#05 R"));
  EXPECT_EQ(read.entries[0].t_ns % 1'000'000'000, 523'000'000) << "20.682 s + 1.841 s";
  EXPECT_THAT(read.remarks,
              ElementsAre(HasSubstr("1 left out: records of the status of the bus; the first is log:7:")));
}

TEST(Trc, OfVersions11To13IsRead) {
  EXPECT_THAT(frames_of(read_log(";$FILEVERSION=1.1 \n;$STARTTIME=37704.5364870833 \n     1)      1059.9  Rx "
                                 "        0300  2  00 04 \n"
                                 "     3)      1298.9  Tx     00000400  1  00 \n     5)      1346.8  Warng  "
                                 "FFFFFFFF  4  00 00 00 04  BUSLIGHT \n"
                                 "     6)      1349.2  Error      0008  4  00 19 08 08 \n     7)      1352.7 "
                                 " Rx         0100  3  RTR \n")),
              ElementsAre("can0 300#0004 R", "can0 00000400#00 T", "can0 20000080#0000000000000000 R",
                          "can0 100#R3 R"));
  EXPECT_THAT(frames_of(read_log(";$FILEVERSION=1.2\n;$STARTTIME=39878.6772258947;\n     1)      1059.900  2 "
                                 " Rx         0300  1  07\n")),
              ElementsAre("can1 300#07 R"));
  EXPECT_THAT(frames_of(read_log(";$FILEVERSION=1.3\n     1)      1059.900 3  Tx        0300 -  1    07\n"
                                 "     7)      1352.743 1  Rx        0100 -  3    RTR\n")),
              ElementsAre("can2 300#07 T", "can0 100#R3 R"));
}

TEST(Trc, OfVersion2IsRead) {
  const auto read = read_log(
      ";$FILEVERSION=2.0\n;$STARTTIME=44548.6028595139\n;$COLUMNS=N,O,T,I,d,l,D\n"
      "      1      1059.900 DT     0300 Rx 2  00 04\n      5      1334.416 FD     0500 Tx 12 01 02 03 04 05 "
      "06 07 08 09 0A 0B 0C\n"
      "      6      1334.522 ER          Rx    04 00 02 00 00\n      7      1334.531 ST          Rx    00 00 "
      "00 08\n"
      "      8      1334.643 EC          Rx    02 02\n      9      1335.156 FB 18EFC034 Tx 1  01\n"
      "     10      1335.157 FE     0500 Tx 1  02\n     11      1335.158 BI     0500 Tx 1  03\n     12      "
      "1336.543 RR     0100 Rx 3\n");
  EXPECT_THAT(frames_of(read), ElementsAre("can0 300#0004 R", "can0 500##40102030405060708090A0B0C T",
                                           "can0 20000080#0000000000000000 R", "can0 18EFC034##501 T",
                                           "can0 500##602 T", "can0 500##703 T", "can0 100#R3 R"));
  EXPECT_EQ(read.entries[0].t_ns % 60'000'000'000, 8'121'900'000) << "7.062 s + 1.0599 s";
  EXPECT_THAT(frames_of(read_log(";$FILEVERSION=2.1\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n      1      1059.900 FD 2 "
                                 "     0500 Rx -  9    01 02 03 04 05 06 07 08 09 0A 0B 0C\n"
                                 "      6      1334.222 ER 1         - Rx -  5    04 00 02 00 00\n      7    "
                                 "  1334.224 EV 1  User-defined event\n")),
              ElementsAre("can1 500##40102030405060708090A0B0C R", "can0 20000080#0000000000000000 R"));
}

TEST(Trc, WhatIsWrongIsSaid) {
  const auto said = [](const std::string& text) { return read_log(text).error; };
  const std::string head = ";$FILEVERSION=1.1\n";
  EXPECT_EQ(said(";$FILEVERSION=3.0\n"), "log:1: expected version 1.0 to 1.3 or 2.x in $FILEVERSION");
  EXPECT_EQ(said(";$FILEVERSION=2.0\n1 1.0 DT 0300 Rx 1 05\n"), "log:2: expected $COLUMNS in the header");
  EXPECT_EQ(said(";$FILEVERSION=2.0\n;$COLUMNS=N,O,T,I,d,D\n"),
            "log:2: expected a column l or L, and the last column D, in $COLUMNS");
  EXPECT_EQ(said(head + "1) x Rx 0300 1 05\n"), "log:2: expected a time in ms, up to 1e12");
  EXPECT_EQ(said(head + "1) 1.0 Rx 0800 1 05\n"),
            "log:2: expected an id of 4 hex digits up to 07FF, or 8 up to 1FFFFFFF");
  EXPECT_EQ(said(head + "1) 1.0 Rx 0300 2 05\n"), "log:2: expected 2 bytes of data");
  EXPECT_EQ(said(head + "1) 1.0 Rx 0300 1 5G\n"), "log:2: expected a byte in place of '5G'");
  EXPECT_EQ(said(head + "1) 1.0 Qx 0300 1 55\n"), "log:2: expected Rx or Tx");
}

}  // namespace
}  // namespace canhil
