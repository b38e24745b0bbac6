// The CSV logs of SavvyCAN.
#include "tests/unit/dbc/logs/reading.hpp"

namespace canhil {
namespace {

using test::read_log;
using testing::ElementsAre;

const std::string csv_head = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\r\n";

TEST(Csv, OfSavvyCanIsRead) {
  EXPECT_THAT(
      read_log(csv_head +
               "166064000,0000021A,false,Rx,0,8,FE,36,12,FE,69,05,07,AD,\r\n1490000000166064,00000123,"
               "true,Tx,1,1,0A,\r\n\r\n"
               "166064001,00000123,false,Rx,0,0,\n"
               "166064002,00000123,false,Rx,0,12,1,2,3,4,5,6,7,8,9,A,B,C\n")
          .lines,
      ElementsAre("(166.064000) can0 21A#FE3612FE690507AD R", "(1490000000.166064) can1 00000123#0A T",
                  "(166.064001) can0 123# R", "(166.064002) can0 123##40102030405060708090A0B0C R"));
}

TEST(Csv, ColumnsMayHaveAnotherOrder) {
  EXPECT_THAT(read_log("ID,Bus,Extended,time stamp,LEN,Dir,D1,D2\n0000021A,1,false,4000,2,Tx,FE,36\n").lines,
              ElementsAre("(0.004000) can1 21A#FE36 T"));
}

TEST(Csv, OfOldVersionsIsRead) {
  EXPECT_THAT(
      read_log("Time Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n4000,0000021A,false,2,2,FE,36,\n")
          .lines,
      ElementsAre("(0.004000) can2 21A#FE36 R"));
}

TEST(Csv, WhatIsWrongIsSaid) {
  const auto said = [](const std::string& line) { return read_log(csv_head + line + "\n").error; };
  EXPECT_EQ(read_log("Time Stamp,ID,Extended,Dir,LEN,D1\n").error,
            "log:1: expected a column 'bus' in the header");
  EXPECT_EQ(said("x,21A,false,Rx,0,0,"), "log:2: expected the time in microseconds");
  EXPECT_EQ(said("1,821A,false,Rx,0,0,"), "log:2: expected an id");
  EXPECT_EQ(said("1,21A,false,Rx,,0,"), "log:2: expected the number of the bus");
  EXPECT_EQ(said("1,21A,false,Rx,0,9,"), "log:2: expected 0-8, 12, 16, 20, 24, 32, 48 or 64 bytes");
  EXPECT_EQ(said("1,21A,false,Rx,0,2,01"), "log:2: expected 2 bytes of data");
  EXPECT_EQ(said("1,21A,false,Rx,0,1,0G"), "log:2: expected a byte in place of '0G'");
}

}  // namespace
}  // namespace canhil
