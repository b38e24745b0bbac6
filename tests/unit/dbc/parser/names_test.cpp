// The names of objects and of values: long symbols, and values of 64 bits.
#include <gmock/gmock.h>

#include "dbc/parser/codec.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

using testing::ElementsAre;

TEST(LongSymbols, AreTheNamesWhereverTheShortNamesWere) {
  const auto database = parse_leniently(R"(BU_: Short Other
BO_ 1 M_0000: 8 Short
 SG_ mux_0000 M : 0|8@1+ (1,0) [0|0] "" Other,Short
 SG_ s_0000 m1 : 8|8@1+ (1,0) [0|0] "" Short
 SG_ plain m2 : 8|8@1+ (1,0) [0|0] "" Short
BO_TX_BU_ 1 : Other,Short;
EV_ e_0000: 0 [0|1] "" 0 1 DUMMY_NODE_VECTOR0 Short;
SIG_GROUP_ 1 g 1 : s_0000 plain;
SG_MUL_VAL_ 1 s_0000 mux_0000 1-1;
BA_DEF_ BU_ "SystemNodeLongSymbol" STRING ;
BA_DEF_ BO_ "SystemMessageLongSymbol" STRING ;
BA_DEF_ SG_ "SystemSignalLongSymbol" STRING ;
BA_DEF_ EV_ "SystemEnvVarLongSymbol" STRING ;
BA_DEF_REL_ BU_SG_REL_ "R" INT 0 9;
BA_DEF_DEF_ "SystemSignalLongSymbol" "";
BA_ "SystemNodeLongSymbol" BU_ Short "A_long_node";
BA_ "SystemMessageLongSymbol" BO_ 1 "A_long_message";
BA_ "SystemSignalLongSymbol" SG_ 1 mux_0000 "A_long_multiplexor";
BA_ "SystemSignalLongSymbol" SG_ 1 s_0000 "A_long_signal";
BA_ "SystemEnvVarLongSymbol" EV_ e_0000 "A_long_variable";
BA_REL_ "R" BU_SG_REL_ Short SG_ 1 s_0000 3;
VAL_ 1 s_0000 1 "one" ;
)",
                                        "t.dbc");
  ASSERT_TRUE(database) << database.error().message;
  EXPECT_EQ(database->nodes[0].name, "A_long_node");
  EXPECT_EQ(database->variables[0].name, "A_long_variable");
  EXPECT_THAT(database->variables[0].nodes, ElementsAre("A_long_node"));
  const Message& message = database->messages[0];
  EXPECT_EQ(message.name, "A_long_message");
  EXPECT_EQ(message.sender, "A_long_node");
  EXPECT_THAT(message.further_senders, ElementsAre("Other"));
  EXPECT_THAT(message.signals[0].receivers, ElementsAre("Other", "A_long_node"));
  EXPECT_EQ(message.signals[1].name, "A_long_signal");
  EXPECT_EQ(message.signals[1].multiplexed_by, "A_long_multiplexor");
  EXPECT_EQ(message.signals[2].multiplexed_by, "A_long_multiplexor");
  EXPECT_EQ(message.signals[2].name, "plain");
  EXPECT_THAT(message.groups[0].signals, ElementsAre("A_long_signal", "plain"));
  EXPECT_EQ(database->relations[0].node, "A_long_node");
  EXPECT_EQ(database->relations[0].target, "A_long_signal");
  EXPECT_EQ(value_name(message.signals[1], 1), "one");
}

TEST(ValueNames, HoldEveryRawValueOf64Bits) {
  const Inspection inspection = inspect(R"(BU_: A
BO_ 1 M: 16 A
 SG_ u : 0|64@1+ (1,0) [0|0] "" A
 SG_ i : 64|64@1- (1,0) [0|0] "" A
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN_FD";
BA_ "VFrameFormat" BO_ 1 0;
VAL_ 1 u 18446744073709551615 "none" 9223372036854775808 "half" 0 "off" ;
VAL_ 1 i -9223372036854775808 "lowest" -1 "minus" 9223372036854775807 "highest" ;
)");
  EXPECT_TRUE(inspection.findings.empty()) << inspection.findings[0].what;
  ASSERT_TRUE(inspection.database);
  const auto& [u, i] =
      std::tie(inspection.database->messages[0].signals[0], inspection.database->messages[0].signals[1]);
  EXPECT_EQ(value_name(u, UINT64_MAX), "none");
  EXPECT_EQ(value_name(u, std::uint64_t{1} << 63U), "half");
  EXPECT_EQ(value_name(i, UINT64_MAX), "minus");
  EXPECT_EQ(value_name(i, std::uint64_t{1} << 63U), "lowest");
}

TEST(ValueNames, BeyondTheBitsAreFound) {
  const Inspection inspection = inspect(R"(BU_: A
BO_ 1 M: 8 A
 SG_ u : 0|64@1+ (1,0) [0|0] "" A
VAL_ 1 u 18446744073709551616 "a" -1 "b" 99999999999999999999999999999999999999999999 "c" ;
)");
  ASSERT_EQ(inspection.findings.size(), 3U);
  EXPECT_EQ(inspection.findings[0].what,
            "value 18446744073709551616 \"a\" of M.u does not fit, expected one of 64 unsigned bits");
}

}  // namespace
}  // namespace canhil::dbc
