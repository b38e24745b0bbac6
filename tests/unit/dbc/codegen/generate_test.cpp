#include "dbc/codegen/generate.hpp"

#include <gmock/gmock.h>

#include "dbc/codegen/load.hpp"
#include "dbc/codegen/names.hpp"
#include "dbc/codegen/placement.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/bit_length.hpp"

namespace canhil::dbc {
namespace {

using testing::HasSubstr;

Database database_of(std::string_view text) {
  auto database = parse(text, "test.dbc");
  EXPECT_TRUE(database) << database.error().message;
  return database.value_or(Database{});
}

TEST(Identifier, StaysCloseToTheText) {
  EXPECT_EQ(identifier("running"), "running");
  EXPECT_EQ(identifier("fault (hot)"), "fault_hot");
  EXPECT_EQ(identifier("3 of 4"), "_3_of_4");
  EXPECT_EQ(identifier("class"), "class_");
  EXPECT_EQ(identifier("\xC3\xA4"), "value");
  EXPECT_EQ(identifier(""), "value");
}

TEST(Literal, IsExactAndADouble) {
  EXPECT_EQ(literal(2), "2.0");
  EXPECT_EQ(literal(0.1), "0.1");
  EXPECT_EQ(literal(-1e-7), "-1e-07");
  EXPECT_EQ(literal(1.0 / 3), "0.3333333333333333");
}

TEST(IntegerType, IsTheSmallest) {
  EXPECT_EQ(integer_type(1, false), "std::uint8_t");
  EXPECT_EQ(integer_type(9, true), "std::int16_t");
  EXPECT_EQ(integer_type(32, false), "std::uint32_t");
  EXPECT_EQ(integer_type(33, true), "std::int64_t");
}

Message message_of(unsigned size) {
  Message message;
  message.size = size;
  return message;
}

Signal signal_at(unsigned start_bit, unsigned length) {
  Signal signal;
  signal.start_bit = start_bit;
  signal.length = length;
  return signal;
}

TEST(Placement, SignalsOverNineBytesAreTwoPieces) {
  const auto pieces = pieces_of(message_of(64), signal_at(13, 60));
  ASSERT_EQ(pieces.size(),
            2U);  // bits 13..71 are in the word at byte 1, bit 72 only in the word at byte 2
  EXPECT_EQ(pieces[1].word.first, 1U);
  EXPECT_EQ(pieces[1].shift, 5U);
  EXPECT_EQ(pieces[1].length, 59U);
  EXPECT_EQ(pieces[0].word.first, 2U);
  EXPECT_EQ(pieces[0].shift, 56U);
  EXPECT_EQ(pieces[0].length, 1U);
  EXPECT_EQ(pieces[0].raw_shift, 59U);
}

TEST(Placement, LoadsStayInsideOfTheMessage) {
  const auto piece = pieces_of(message_of(12), signal_at(90, 6)).at(0);
  EXPECT_EQ(piece.word.first, 4U);
  EXPECT_EQ(piece.shift, 90U - 32U);
}

TEST(Enums, ShareATypeOnlyWhereTheValuesAreTheTables) {
  const Database database = database_of(R"(BS_:
BU_: A
VAL_TABLE_ OnOff 0 "off" 1 "on" ;
BO_ 1 M: 8 A
 SG_ a : 0|2@1+ (1,0) [0|3] "" A
 SG_ b : 8|12@1+ (1,0) [0|0] "" A
 SG_ c : 24|2@1+ (1,0) [0|3] "" A
 SG_ d : 32|4@1- (1,0) [0|0] "" A
VAL_ 1 a 1 "on" 0 "off" ;
VAL_ 1 b 0 "off" 1 "on" ;
VAL_ 1 c 0 "off" 1 "on" 2 "error" ;
VAL_ 1 d -1 "minus" ;
)");
  const Enums enums(database);
  const Message& message = database.messages[0];
  EXPECT_EQ(enums.name_of(message, message.signals[0]), "OnOff");
  EXPECT_EQ(enums.name_of(message, message.signals[1]), "OnOff");
  EXPECT_EQ(enums.name_of(message, message.signals[2]), "M_c");
  EXPECT_EQ(enums.name_of(message, message.signals[3]), "M_d");
  EXPECT_EQ(enums.all()[0].underlying, "std::uint16_t");  // wide enough for b
  EXPECT_EQ(enums.all()[2].underlying, "std::int8_t");
}

TEST(GenerateHeader, IsTheSameEveryTime) {
  const auto database = read_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(database);
  const auto once = generate_header(*database, "canhil::messages", "canhil.dbc");
  ASSERT_TRUE(once);
  EXPECT_EQ(*once, *generate_header(*database, "canhil::messages", "canhil.dbc"));
  EXPECT_THAT(*once, testing::Not(HasSubstr(SOURCE_DIR)));
}

TEST(GenerateHeader, RefusesADataIdWithoutProtectionFields) {
  const Database database = database_of(R"(BS_:
BU_: A
BO_ 1 M: 8 A
 SG_ e2e_crc : 0|8@1+ (1,0) [0|0] "" A
 SG_ e2e_counter : 12|4@1+ (1,0) [0|0] "" A
BA_DEF_ BO_ "E2eDataId" INT 0 65535;
BA_ "E2eDataId" BO_ 1 7;
)");
  const auto header = generate_header(database, "m", "x.dbc");
  ASSERT_FALSE(header);
  EXPECT_EQ(header.error().message,
            "x.dbc:3:5: message M has an E2eDataId, expected the signals e2e_crc : 0|8@1+ and e2e_counter : "
            "8|4@1+");
}

TEST(Load, SumsCyclicMessagesOfASender) {
  const Database database = database_of(R"(BS_:
BU_: A B
BO_ 1 M: 8 A
BO_ 2 N: 8 A
BO_ 3 O: 0 B
BA_DEF_ "Baudrate" INT 0 1000000;
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_ "Baudrate" 250000;
BA_ "GenMsgCycleTime" BO_ 1 10;
BA_ "GenMsgCycleTime" BO_ 3 100;
)");
  const std::string table = load_table(database);
  EXPECT_THAT(table, HasSubstr("A                       1            1      13500    5.40%\n"));
  EXPECT_THAT(table, HasSubstr("B                       1            0        550    0.22%\n"));
  EXPECT_THAT(table, HasSubstr("14050    5.62% of 250000 bit/s\n"));
}

TEST(Load, OfEveryNodeOfTheContractIsUnderHalfOfAMegabitPerSecond) {
  const auto database = read_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(database);
  double bits_per_s = 0;
  for (const Message& message : database->messages) {
    if (message.cycle_time_us > 0)
      bits_per_s += static_cast<double>(wire::worst_case_length(message.size, message.extended).bits()) *
                    1e6 / static_cast<double>(message.cycle_time_us);
  }
  EXPECT_GT(bits_per_s, 0);
  EXPECT_LT(bits_per_s, 0.5 * 1e6);
}

}  // namespace
}  // namespace canhil::dbc
