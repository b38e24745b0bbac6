// Every error with its place and its complete text: one line for each invalid input.
#include <gtest/gtest.h>

#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

struct Wrong {
  const char* name;
  std::string text;     ///< after the head
  const char* message;  ///< after "t.dbc:"
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

// Six lines, so that the text of each case begins in line 7.
constexpr const char* head =
    "BS_:\nBU_: A B\nBO_ 1 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|255] \"\" B\n SG_ t : 8|8@1- (1,0) [0|0] \"\" "
    "B\n\n";
constexpr const char* definitions =
    "BA_DEF_ BO_ \"I\" INT 0 10;\nBA_DEF_ SG_ \"F\" FLOAT -1.5 1.5;\nBA_DEF_ \"E\" ENUM \"x\",\"y\";\n";
constexpr const char* format =
    "BA_DEF_ BO_ \"VFrameFormat\" ENUM "
    "\"StandardCAN\",\"ExtendedCAN\",\"StandardCAN_FD\",\"ExtendedCAN_FD\";\n";

class ParseError : public testing::TestWithParam<Wrong> {};

TEST_P(ParseError, IsOneLineThatSaysWhereWhatAndWhatWasExpected) {
  const auto database = parse(head + GetParam().text, "t.dbc");
  ASSERT_FALSE(database) << "accepted: " << GetParam().text;
  EXPECT_EQ(database.error().message, std::string("t.dbc:") + GetParam().message);
}

std::string signal_line(const std::string& text) { return "BO_ 2 N: 8 A\n SG_ " + text; }

const Wrong wrong[] = {
    // text
    {"string_of_two_lines", "\"a\nb\"",
     "7:1: unexpected \"a b\", expected a section such as BO_, CM_ or BA_"},
    {"character", "BO_ 2 N: 8 A %",
     "7:14: unexpected character '%', expected a keyword, a name, a number, a string or punctuation"},
    {"string_end", "CM_ \"x", "7:5: string without end, expected '\"' before the next section"},
    {"section", "XY_ 1", "7:1: unexpected 'XY_', expected a section such as BO_, CM_ or BA_"},
    {"section_string", "\"x\"", "7:1: unexpected \"x\", expected a section such as BO_, CM_ or BA_"},
    {"file_end", "BO_ 2", "7:6: unexpected the end of the file, expected the name of the message"},
    {"keyword_as_name", "BO_ 2 BO_: 8 A", "7:7: unexpected 'BO_', expected the name of the message"},
    {"colon", "BO_ 2 N 8 A", "7:9: unexpected '8', expected ':'"},
    // messages
    {"id_text", "BO_ x N: 8 A", "7:5: unexpected 'x', expected a message id, an integer in 0..4294967295"},
    {"id_range", "BO_ 2048 N: 8 A",
     "7:5: message id 2048 out of range, expected at most 2047, or bit 31 set for an extended id"},
    {"id_extended_range", "BO_ 2684354560 N: 8 A",
     "7:5: message id 536870912 out of range, expected at most 536870911"},
    {"id_twice", "BO_ 1 N: 8 A", "7:5: message N has the id 1 of M, expected a unique id"},
    {"message_twice", "BO_ 2 M: 8 A", "7:7: message M is defined a second time, expected a unique name"},
    {"size", "BO_ 2 N: 65 A",
     "7:5: message N has 65 bytes, expected at most 64, or a fast packet of NMEA 2000 or a message of SAE "
     "J1939"},
    {"size_classic", "BO_ 2 N: 9 A",
     "7:5: message N has 9 bytes, expected at most 8, or VFrameFormat StandardCAN_FD or ExtendedCAN_FD"},
    {"size_fd", std::string("BO_ 2 N: 9 A\n") + format + "BA_ \"VFrameFormat\" BO_ 2 2;",
     "7:5: message N has 9 bytes, expected 0..8, 12, 16, 20, 24, 32, 48 or 64"},
    {"format", std::string(format) + "BA_ \"VFrameFormat\" BO_ 1 1;",
     "3:5: message M has the frame format ExtendedCAN and a standard id, expected both the same"},
    {"sender", "BO_ 2 N: 8 C", "7:12: no node 'C', expected one listed in BU_"},
    {"node_twice", "BU_: C C", "7:8: node 'C' a second time, expected every node once"},
    {"transmitter", "BO_TX_BU_ 1 : A,C;", "7:17: no node 'C', expected one listed in BU_"},
    {"transmitter_message", "BO_TX_BU_ 9 : A;",
     "7:11: no message has the id 9, expected one defined by BO_ above"},
    // signals
    {"signal_twice", signal_line("a : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ a : 8|8@1+ (1,0) [0|0] \"\" B"),
     "9:6: signal N.a is defined a second time, expected a unique name"},
    {"start", signal_line("a : 14280|8@1+ (1,0) [0|0] \"\" B"),
     "8:10: unexpected '14280', expected a start bit, an integer in 0..14279"},
    {"length_0", signal_line("a : 0|0@1+ (1,0) [0|0] \"\" B"), "8:6: signal N.a has 0 bits, expected 1..64"},
    {"length_65", signal_line("a : 0|65@1+ (1,0) [0|0] \"\" B"),
     "8:6: signal N.a has 65 bits, expected 1..64"},
    {"byte_order", signal_line("a : 0|8@2+ (1,0) [0|0] \"\" B"),
     "8:14: unexpected '2', expected the byte order 0 (Motorola) or 1 (Intel), an integer in 0..1"},
    {"sign", signal_line("a : 0|8@1 (1,0) [0|0] \"\" B"),
     "8:16: unexpected '(', expected the sign '+' (unsigned) or '-' (signed)"},
    {"scale_text", signal_line("a : 0|8@1+ (x,0) [0|0] \"\" B"), "8:18: unexpected 'x', expected a scale"},
    {"scale_huge", signal_line("a : 0|8@1+ (1e999,0) [0|0] \"\" B"),
     "8:18: unexpected '1e999', expected a scale"},
    {"scale_0", signal_line("a : 0|8@1+ (0,0) [0|0] \"\" B"),
     "8:6: signal N.a has scale 0, expected another"},
    {"min_max", signal_line("a : 0|8@1+ (1,0) [5|4] \"\" B"),
     "8:6: signal N.a has minimum 5 > maximum 4, expected minimum <= maximum"},
    {"no_value", signal_line("a : 0|8@1+ (1,0) [256|300] \"\" B"),
     "8:6: signal N.a cannot take any value in [256|300], expected a range that its bits, scale and offset "
     "reach"},
    {"unit", signal_line("a : 0|8@1+ (1,0) [0|0] B"), "8:29: unexpected 'B', expected a unit in quotes"},
    {"receiver", signal_line("a : 0|8@1+ (1,0) [0|0] \"\" C"),
     "8:32: no node 'C', expected one listed in BU_"},
    {"receiver_none", signal_line("a : 0|8@1+ (1,0) [0|0] \"\"\n"),
     "9:1: unexpected the end of the file, expected a receiver"},
    {"outside_intel", signal_line("a : 57|8@1+ (1,0) [0|0] \"\" B"),
     "8:6: signal N.a reaches beyond the message, expected all 8 bits inside of its 8 bytes"},
    {"outside_motorola", signal_line("a : 62|8@0+ (1,0) [0|0] \"\" B"),
     "8:6: signal N.a reaches beyond the message, expected all 8 bits inside of its 8 bytes"},
    {"overlap", signal_line("a : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 0|2@0+ (1,0) [0|0] \"\" B"),
     "9:6: signal N.b overlaps a, expected bits of its own"},
    {"float_length", "SIG_VALTYPE_ 1 s : 1;", "7:16: signal M.s has 8 bits, expected 32 for a float"},
    {"double_length", "SIG_VALTYPE_ 1 s : 2;", "7:16: signal M.s has 8 bits, expected 64 for a double"},
    {"float_type", "SIG_VALTYPE_ 1 s : 3;",
     "7:20: unexpected '3', expected the type 0 (integer), 1 (float) or 2 (double), an integer in 0..2"},
    {"group", "SIG_GROUP_ 1 g 1 : s x;", "7:22: message M has no signal 'x', expected one of its SG_"},
    // multiplexing
    {"mux_word", signal_line("a x : 0|8@1+ (1,0) [0|0] \"\" B"),
     "8:8: unexpected 'x', expected ':' or a multiplexing indicator M, m<number> or m<number>M"},
    {"mux_number", signal_line("a m : 0|8@1+ (1,0) [0|0] \"\" B"),
     "8:8: unexpected 'm', expected ':' or a multiplexing indicator M, m<number> or m<number>M"},
    {"mux_alone", signal_line("a m1 : 0|8@1+ (1,0) [0|0] \"\" B"),
     "8:6: signal N.a is multiplexed but N has no multiplexor, expected a signal with the indicator M"},
    {"mux_two",
     signal_line("a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b M : 8|8@1+ (1,0) [0|0] \"\" B\n SG_ c m1 : 16|8@1+ "
                 "(1,0) [0|0] \"\" B"),
     "9:6: message N has a second multiplexor b, expected one, or SG_MUL_VAL_ for every multiplexed signal"},
    {"mux_value", signal_line("a M : 0|2@1+ (1,0) [0|0] \"\" B\n SG_ c m4 : 16|8@1+ (1,0) [0|0] \"\" B"),
     "9:6: signal N.c is present when a is 4, expected a value of its 2 bits: 0..3"},
    {"mux_signed", signal_line("a M : 0|2@1- (1,0) [0|0] \"\" B"),
     "8:6: multiplexor N.a is signed, expected an unsigned integer"},
    {"mux_float", signal_line("a M : 0|32@1- (1,0) [0|0] \"\" B\nSIG_VALTYPE_ 2 a : 1;"),
     "8:6: multiplexor N.a is a float, expected an unsigned integer"},
    {"mux_overlap",
     signal_line("a M : 0|2@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 8|8@1+ (1,0) [0|0] \"\" B\n SG_ c m1 : 8|8@1+ "
                 "(1,0) [0|0] \"\" B"),
     "10:6: signal N.c overlaps b, expected bits of its own"},
    {"mux_overlap_base",
     signal_line("a M : 0|2@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 1|8@1+ (1,0) [0|0] \"\" B"),
     "9:6: signal N.b overlaps a, expected bits of its own"},
    {"mux_circle",
     signal_line("a m1M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1M : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 a "
                 "b 1-1;\nSG_MUL_VAL_ 2 b a 1-1;"),
     "8:6: signal N.a is multiplexed in a circle, expected a multiplexor that is always present"},
    {"mux_not_multiplexed", "SG_MUL_VAL_ 1 s t 1-1;",
     "7:15: signal M.s is not multiplexed, expected the indicator m<number> in its SG_"},
    {"mux_no_multiplexor",
     signal_line(
         "a m1 : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 a b 1-1;"),
     "10:17: signal N.b is not a multiplexor, expected the indicator M in its SG_"},
    {"mux_range",
     signal_line(
         "a m1 : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b M : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 a b 3-1;"),
     "10:19: range 3-1 is empty, expected first <= last"},
    {"mux_given_twice",
     signal_line("a m1 : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b M : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 a b "
                 "1-1;\nSG_MUL_VAL_ 2 a b 1-1;"),
     "11:15: multiplexing of N.a a second time, expected SG_MUL_VAL_ once"},
    // values
    {"value_message", "VAL_ 9 s 1 \"x\" ;",
     "7:6: no message has the id 9, expected one defined by BO_ above"},
    {"value_signal", "VAL_ 1 x 1 \"x\" ;", "7:8: message M has no signal 'x', expected one of its SG_"},
    {"value_variable", "VAL_ x 1 \"x\" ;",
     "7:6: no environment variable 'x', expected one defined by EV_ above"},
    {"value_twice", "VAL_ 1 s 1 \"x\" 1 \"y\" ;",
     "7:16: value 1 named a second time, expected every value once"},
    {"values_twice", "VAL_ 1 s 1 \"x\" ;\nVAL_ 1 s 2 \"y\" ;",
     "8:8: values of M.s a second time, expected VAL_ once"},
    {"value_unsigned", "VAL_ 1 s 256 \"x\" ;",
     "4:6: value 256 \"x\" of M.s does not fit, expected one of 8 unsigned bits"},
    {"value_signed", "VAL_ 1 t -129 \"x\" ;",
     "5:6: value -129 \"x\" of M.t does not fit, expected one of 8 signed bits"},
    {"value_float", signal_line("a : 0|32@1- (1,0) [0|0] \"\" B\nSIG_VALTYPE_ 2 a : 1;\nVAL_ 2 a 1 \"x\" ;"),
     "8:6: float signal N.a has named values, expected an integer signal"},
    {"value_name", "VAL_ 1 s 1 x ;", "7:12: unexpected 'x', expected the name of the value in quotes"},
    {"table_twice", "VAL_TABLE_ T 1 \"x\" ;\nVAL_TABLE_ T 1 \"x\" ;",
     "8:12: value table T is defined a second time, expected a unique name"},
    // comments
    {"comment_node", "CM_ BU_ C \"x\";", "7:9: no node 'C', expected one listed in BU_"},
    {"comment_message", "CM_ BO_ 9 \"x\";",
     "7:9: no message has the id 9, expected one defined by BO_ above"},
    {"comment_signal", "CM_ SG_ 1 x \"x\";", "7:11: message M has no signal 'x', expected one of its SG_"},
    {"comment_variable", "CM_ EV_ x \"x\";",
     "7:9: no environment variable 'x', expected one defined by EV_ above"},
    {"comment_kind", "CM_ XY_ 1 \"x\";",
     "7:5: unexpected 'XY_', expected BU_, BO_, SG_, EV_ or a comment in quotes"},
    {"comment_end", "CM_ \"x\"", "7:8: unexpected the end of the file, expected ';'"},
    // environment variables
    {"variable_twice",
     "EV_ e: 0 [0|1] \"\" 0 1 DUMMY_NODE_VECTOR0 A;\nEV_ e: 0 [0|1] \"\" 0 1 DUMMY_NODE_VECTOR0 A;",
     "8:5: environment variable e is defined a second time, expected a unique name"},
    {"variable_node", "EV_ e: 0 [0|1] \"\" 0 1 DUMMY_NODE_VECTOR0 C;",
     "7:42: no node 'C', expected one listed in BU_"},
    {"variable_data", "ENVVAR_DATA_ e: 3;",
     "7:14: no environment variable 'e', expected one defined by EV_ above"},
    // attributes
    {"attribute_undefined", "BA_ \"X\" 1;", "7:5: attribute \"X\" is not defined, expected a BA_DEF_ above"},
    {"attribute_default_undefined", "BA_DEF_DEF_ \"X\" 1;",
     "7:13: attribute \"X\" is not defined, expected a BA_DEF_ above"},
    {"attribute_twice", std::string(definitions) + "BA_DEF_ BO_ \"I\" INT 0 10;",
     "10:13: attribute \"I\" is defined a second time, expected a unique name"},
    {"attribute_type", "BA_DEF_ \"X\" BOOL;",
     "7:13: unexpected 'BOOL', expected the type INT, HEX, FLOAT, STRING or ENUM"},
    {"attribute_limits", "BA_DEF_ \"X\" INT 5 4;",
     "7:17: attribute \"X\" has minimum 5 > maximum 4, expected minimum <= maximum"},
    {"attribute_int", std::string(definitions) + "BA_ \"I\" BO_ 1 11;",
     "10:15: 11 is outside of attribute \"I\", expected 0..10"},
    {"attribute_int_fraction", std::string(definitions) + "BA_ \"I\" BO_ 1 1.5;",
     "10:15: unexpected '1.5', expected a value, an integer"},
    {"attribute_float", std::string(definitions) + "BA_ \"F\" SG_ 1 s -2;",
     "10:17: -2 is outside of attribute \"F\", expected -1.5..1.5"},
    {"attribute_enum", std::string(definitions) + "BA_ \"E\" 2;",
     "10:9: 2 is not a value of attribute \"E\", expected 0..1"},
    {"attribute_label", std::string(definitions) + "BA_ \"E\" \"z\";",
     "10:9: \"z\" is not a value of attribute \"E\", expected one of \"x\", \"y\""},
    {"attribute_default", std::string(definitions) + "BA_DEF_DEF_ \"I\" 11;",
     "10:17: 11 is outside of attribute \"I\", expected 0..10"},
    {"attribute_default_twice", std::string(definitions) + "BA_DEF_DEF_ \"I\" 1;\nBA_DEF_DEF_ \"I\" 1;",
     "11:13: default of attribute \"I\" a second time, expected it once"},
    {"attribute_owner", std::string(definitions) + "BA_ \"I\" SG_ 1 s 1;",
     "10:9: attribute \"I\" given to signals, expected messages"},
    {"attribute_owner_none", std::string(definitions) + "BA_ \"I\" 1;",
     "10:9: attribute \"I\" given to the network, expected messages"},
    {"attribute_message", std::string(definitions) + "BA_ \"I\" BO_ 9 1;",
     "10:13: no message has the id 9, expected one defined by BO_ above"},
    {"attribute_signal", std::string(definitions) + "BA_ \"F\" SG_ 1 x 1;",
     "10:15: message M has no signal 'x', expected one of its SG_"},
    {"attribute_value_twice", std::string(definitions) + "BA_ \"I\" BO_ 1 1;\nBA_ \"I\" BO_ 1 2;",
     "11:5: attribute \"I\" given a second time, expected one value"},
    {"attribute_data_id", "BA_DEF_ BO_ \"E2eDataId\" INT 0 0;\nBA_ \"E2eDataId\" BO_ 1 65536;",
     "3:5: message M has E2eDataId 65536, expected 0..65535"},
    {"cycle_time_negative", "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 0;\nBA_ \"GenMsgCycleTime\" BO_ 1 -5;",
     "3:5: message M has GenMsgCycleTime -5 ms, expected 0 (none) or 0.001..1e9"},
    {"cycle_time_large",
     "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 0;\nBA_ \"GenMsgCycleTime\" BO_ 1 9223372036854775807;",
     "3:5: message M has GenMsgCycleTime 9.223372036854776e+18 ms, expected 0 (none) or 0.001..1e9"},
    {"cycle_time_vanishing",
     "BA_DEF_ BO_ \"GenMsgCycleTime\" FLOAT 0 0;\nBA_ \"GenMsgCycleTime\" BO_ 1 0.0001;",
     "3:5: message M has GenMsgCycleTime 0.0001 ms, expected 0 (none) or 0.001..1e9"},
    {"mux_range_beyond_64_bits",
     "BO_ 2 N: 8 A\n SG_ x M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ y m0 : 8|8@1+ (1,0) "
     "[0|0] \"\" B\nSG_MUL_VAL_ 2 y x 3-18446744073709551616;",
     "10:20: unexpected '-18446744073709551616', expected '-' and the last value, an integer in "
     "0..18446744073709551615"},
    {"relation_undefined", "BA_REL_ \"X\" BU_BO_REL_ A 1 1;",
     "7:9: attribute \"X\" is not defined, expected a BA_DEF_REL_ above"},
    {"relation_owner", "BA_DEF_REL_ BU_BO_REL_ \"R\" INT 0 1;\nBA_REL_ \"R\" BU_SG_REL_ A SG_ 1 s 1;",
     "8:13: attribute \"R\" given to nodes with signals, expected nodes with messages"},
    {"relation_kind", "BA_DEF_REL_ BO_ \"R\" INT 0 1;",
     "7:13: unexpected 'BO_', expected BU_BO_REL_, BU_SG_REL_ or BU_EV_REL_"},
    {"definition_kind", "BA_DEF_ BU_BO_REL_ \"R\" INT 0 1;",
     "7:9: unexpected 'BU_BO_REL_', expected BU_, BO_, SG_ or EV_"},
    {"relation_node", "BA_DEF_REL_ BU_BO_REL_ \"R\" INT 0 1;\nBA_REL_ \"R\" BU_BO_REL_ C 1 1;",
     "8:24: no node 'C', expected one listed in BU_"},
};

INSTANTIATE_TEST_SUITE_P(Each, ParseError, testing::ValuesIn(wrong),
                         [](const testing::TestParamInfo<Wrong>& one) { return one.param.name; });

}  // namespace
}  // namespace canhil::dbc
