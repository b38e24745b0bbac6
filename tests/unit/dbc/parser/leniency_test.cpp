// Each rule of the lenient reader: its place in the text, its finding, and its consequence.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <set>

#include "dbc/parser/parse.hpp"
#include "dbc/parser/plan.hpp"

namespace canhil::dbc {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Lenient {
  Rule rule;
  std::string text;      ///< after the head
  const char* findings;  ///< "line:column rule", separated by ", "
  std::function<bool(const Database&)> follows;
};

void PrintTo(const Lenient& lenient, std::ostream* out) { *out << text_of(lenient.rule).id; }

// Six lines, so that the text of each case begins in line 7.
constexpr const char* first_lines =
    "BS_:\nBU_: A B\nBO_ 1 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|255] \"\" B\n SG_ t : 8|8@1- (1,0) [0|0] \"\" "
    "B\n\n";

std::string message_2(const std::string& signal) { return "BO_ 2 N: 8 A\n SG_ " + signal; }

const Message& last(const Database& database) { return database.messages.back(); }
const Signal& last_signal(const Database& database) { return last(database).signals.back(); }
const Signal& s_of(const Database& database) { return database.messages[0].signals[0]; }
bool has_one_message(const Database& database) { return database.messages.size() == 1; }
bool has_no_signal(const Database& database) { return last(database).signals.empty(); }

bool has_no_limits(const Database& database) {
  return last_signal(database).minimum == 0 && last_signal(database).maximum == 0;
}

/// The bytes of a frame of the last message, with the value 1 in every signal.
std::vector<std::uint8_t> ones_of(const Database& database) {
  const MessagePlan plan(last(database));
  std::vector<std::uint8_t> data(plan.size());
  EXPECT_TRUE(plan.encode(std::vector<double>(plan.signals(), 1), data));
  return data;
}

constexpr const char* integer_attribute = "BA_DEF_ BO_ \"I\" INT 0 10;\n";

const AttributeValue* attribute_i(const Database& database) {
  const auto found = database.messages[0].attributes.find("I");
  return found == database.messages[0].attributes.end() ? nullptr : &found->second;
}
bool i_is(const Database& database, std::int64_t value) {
  const AttributeValue* found = attribute_i(database);
  return found != nullptr && *found == AttributeValue(value);
}

const Lenient cases[] = {
    {Rule::unfinished_string, "CM_ \"x\nCM_ BO_ 1 \"read\";", "7:5 unfinished-string, 8:1 missing-semicolon",
     [](const Database& d) { return d.comment == "x" && d.messages[0].comment == "read"; }},
    {Rule::unreadable_message, "BO_ 2 : 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" B\nCM_ \"read\";",
     "7:7 unreadable-message",
     [](const Database& d) {
       return has_one_message(d) && last(d).signals.size() == 2 && d.comment == "read";
     }},
    {Rule::unreadable_signal,
     message_2("a m : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b 0|8@1+\n SG_ c : 16|8@1+ (1,0) [0|0] \"\" B\n"
               "CM_ SG_ 2 c \"read\";"),
     "8:8 unreadable-signal, 9:8 unreadable-signal",
     [](const Database& d) { return last(d).signals.size() == 1 && last_signal(d).comment == "read"; }},
    {Rule::windows_1252, "CM_ \"\xB0\";", "7:6 windows-1252",
     [](const Database& d) { return d.comment == "\xC2\xB0"; }},
    {Rule::text_encoding, "CM_ \"\x81\";", "7:6 text-encoding",
     [](const Database& d) { return d.comment == "\xEF\xBF\xBD"; }},
    {Rule::independent_signals,
     "BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" "
     "Vector__XXX\nVAL_ 3221225472 x 1 \"one\" ;",
     "7:5 independent-signals", has_one_message},
    {Rule::unreadable_section, "CM_ SG_ 1 \"x\";\nCM_ BO_ 1 \"read\";", "7:11 unreadable-section",
     [](const Database& d) { return d.messages[0].comment == "read"; }},
    {Rule::unknown_section, "FILTER : 1;\nCM_ BO_ 1 \"read\";", "7:1 unknown-section",
     [](const Database& d) { return d.messages[0].comment == "read"; }},
    {Rule::missing_semicolon, "CM_ \"x\"\nVAL_ 1 s 1 \"one\"\nCM_ BO_ 1 \"read\"",
     "8:1 missing-semicolon, 9:1 missing-semicolon, 9:17 missing-semicolon",
     [](const Database& d) {
       return d.comment == "x" && s_of(d).values.size() == 1 && d.messages[0].comment == "read";
     }},
    {Rule::line_comment, "CM_ \"// x\"; // \"not a string\nCM_ BO_ 1 \"read\";", "7:13 line-comment",
     [](const Database& d) { return d.comment == "// x" && d.messages[0].comment == "read"; }},
    {Rule::unreadable_entry, "VAL_ 1 s 0 \"off\" 1 on 2 \"x\" 3 4 \"y\" 5.5 \"z\" 6 \"w\" ;\nCM_ \"read\";",
     "7:20 unreadable-entry, 7:31 unreadable-entry, 7:37 unreadable-entry",
     [](const Database& d) {
       return s_of(d).values == std::vector<ValueName>{{0, "off"}, {2, "x"}, {4, "y"}, {6, "w"}} &&
              d.comment == "read";
     }},
    {Rule::unexpected_character, "VAL_ 1 s ? 1 \"x\" ;\nCM_ \"read\";",
     "7:10 unexpected-character, 7:10 unreadable-entry",
     [](const Database& d) { return s_of(d).values.size() == 1 && d.comment == "read"; }},
    {Rule::name_character, message_2("\xC3\xA4\xC3\xB6 : 0|8@1+ (1,0) [0|0] \"\" B"), "8:6 name-character",
     [](const Database& d) { return last_signal(d).name == "\xC3\xA4\xC3\xB6"; }},
    {Rule::name_begins_with_digit, "BU_: 3C\nBO_ 2 20_N: 8 3C",
     "7:6 name-begins-with-digit, 8:7 name-begins-with-digit, 8:15 name-begins-with-digit",
     [](const Database& d) { return last(d).name == "20_N" && last(d).sender == "3C"; }},
    {Rule::number_too_large, message_2("a : 0|8@1+ (1,0) [-1e999|1e999] \"\" B"),
     "8:24 number-too-large, 8:31 number-too-large",
     [](const Database& d) { return raw_range(last_signal(d))->highest == 255; }},
    {Rule::not_whole, std::string(integer_attribute) + "BA_ \"I\" BO_ 1 1.6;", "8:15 not-whole",
     [](const Database& d) { return i_is(d, 2); }},
    {Rule::undeclared_node,
     "BO_ 2 N: 8 C\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" C,D\nBO_TX_BU_ 2 : C,D;\nCM_ BU_ C \"x\";",
     "7:12 undeclared-node, 8:34 undeclared-node, 10:9 undeclared-node",
     [](const Database& d) {
       return last(d).sender == "C" && last_signal(d).receivers == std::vector<std::string>{"C", "D"} &&
              last(d).further_senders == std::vector<std::string>{"D"} && d.nodes.size() == 2;
     }},
    {Rule::missing_node, "BO_ 2 N: 8\n SG_ a : 0|8@1+ (1,0) [0|0] \"\"\n SG_ b : 8|8@1+ (1,0) [0|0] \"\"\n",
     "8:2 missing-node, 9:2 missing-node, 10:1 missing-node",
     [](const Database& d) {
       return last(d).sender.empty() && last(d).signals.size() == 2 && last_signal(d).receivers.empty();
     }},
    {Rule::duplicate_node, "BU_: C C", "7:8 duplicate-node",
     [](const Database& d) { return d.nodes.size() == 3; }},
    {Rule::missing_extended_flag, "BO_ 2048 N: 8 A\nCM_ BO_ 2147485696 \"read\";",
     "7:5 missing-extended-flag",
     [](const Database& d) { return find_message(d, 2048, true)->comment == "read"; }},
    {Rule::impossible_id,
     "BO_ 1073741824 N: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" B\nCM_ BO_ 1073741824 \"x\";",
     "7:5 impossible-id", has_one_message},
    {Rule::duplicate_id, "BO_ 1 N: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" B", "7:5 duplicate-id",
     [](const Database& d) { return has_one_message(d) && last(d).signals.size() == 2; }},
    {Rule::duplicate_message, "BO_ 2 M: 4 A", "7:7 duplicate-message",
     [](const Database& d) { return find_message(d, 2)->size == 4 && find_message(d, "M")->id == 1; }},
    {Rule::message_size, "BO_ 2 N: 1785 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" B", "7:5 message-size",
     has_one_message},
    {Rule::fd_format_missing, "BO_ 2 N: 12 A", "7:5 fd-format-missing",
     [](const Database& d) { return last(d).fd && last(d).size == 12; }},
    {Rule::fd_size, "BO_ 2 N: 10 A", "7:5 fd-format-missing, 7:5 fd-size",
     [](const Database& d) { return last(d).size == 10; }},
    {Rule::frame_format,
     "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\";\nBA_ \"VFrameFormat\" BO_ 1 1;",
     "3:5 frame-format", [](const Database& d) { return !last(d).extended; }},
    {Rule::cycle_time, "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 0;\nBA_ \"GenMsgCycleTime\" BO_ 1 -5;",
     "3:5 cycle-time", [](const Database& d) { return last(d).cycle_time_us == 0; }},
    {Rule::data_id, "BA_DEF_ BO_ \"E2eDataId\" INT 0 0;\nBA_ \"E2eDataId\" BO_ 1 65536;", "3:5 data-id",
     [](const Database& d) { return last(d).e2e_data_id == 0; }},
    {Rule::duplicate_signal,
     message_2("a : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ a : 8|8@1+ (1,0) [0|0] \"\" B\nCM_ SG_ 2 a \"first\";"),
     "9:6 duplicate-signal",
     [](const Database& d) { return last(d).signals[0].comment == "first" && last(d).signals.size() == 2; }},
    {Rule::signal_beyond_message,
     message_2(
         "a : 57|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 14280|8@1+ (1,0) [0|0] \"\" B\n SG_ c : 62|8@0+ (1,0) "
         "[0|0] \"\" B\n SG_ d : 0|8@1+ (1,0) [0|0] \"\" B\nSIG_GROUP_ 2 g 1 : a d;\nVAL_ 2 a 1 \"x\" ;"),
     "9:10 signal-beyond-message, 8:6 signal-beyond-message, 10:6 signal-beyond-message",
     [](const Database& d) {
       return last(d).signals.size() == 1 && last_signal(d).name == "d" &&
              last(d).groups[0].signals == std::vector<std::string>{"d"};
     }},
    {Rule::signal_length,
     message_2("a : 0|0@1+ (1,0) [0|0] \"\" B\n SG_ b : 0|65@1+ (1,0) [0|0] \"\" B\n SG_ c : 0|1600@1+ (1,0) "
               "[0|0] \"\" B"),
     "10:12 signal-length, 8:6 signal-length, 9:6 signal-length", has_no_signal},
    {Rule::overlap, message_2("a : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 1|8@1+ (2,0) [0|0] \"\" B"),
     "9:6 overlap", [](const Database& d) { return last(d).signals.size() == 2 && ones_of(d)[0] == 1; }},
    {Rule::scale_zero, message_2("a : 0|8@1+ (0,7) [1|2] \"\" B"), "8:6 scale-zero",
     [](const Database& d) {
       std::array<double, 1> value{};
       return MessagePlan(last(d)).decode(std::array<std::uint8_t, 8>{9}, value) && value[0] == 7;
     }},
    {Rule::minimum_above_maximum, message_2("a : 0|8@1+ (1,0) [5|4] \"\" B"), "8:6 minimum-above-maximum",
     has_no_limits},
    {Rule::unreachable_range, message_2("a : 0|8@1+ (1,0) [256|300] \"\" B"), "8:6 unreachable-range",
     has_no_limits},
    {Rule::float_length,
     "SIG_VALTYPE_ 1 s : 1;\n" + message_2("a : 0|64@1- (1,0) [0|0] \"\" B\nSIG_VALTYPE_ 2 a : 1;"),
     "7:16 float-length, 10:16 float-length",
     [](const Database& d) { return !s_of(d).is_float() && last_signal(d).type == RawType::float64; }},
    {Rule::multiplexor_type,
     message_2("a M : 0|2@1- (1,0) [0|0] \"\" B\n SG_ b m3 : 8|8@1+ (1,0) [0|0] \"\" B"),
     "8:6 multiplexor-type",
     [](const Database& d) { return MessagePlan(last(d)).is_present(1, std::array<std::uint8_t, 8>{3}); }},
    {Rule::multiplexor_missing,
     message_2("a m1 : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 8|8@1+ (1,0) [0|0] \"\" B"),
     "8:6 multiplexor-missing",
     [](const Database& d) { return last(d).signals.size() == 1 && last_signal(d).name == "b"; }},
    {Rule::second_multiplexor,
     message_2("a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b M : 8|8@1+ (1,0) [0|0] \"\" B\n SG_ c m1 : 16|8@1+ "
               "(1,0) [0|0] \"\" B\n SG_ d m1 : 24|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 d b 1-1;"),
     "9:6 second-multiplexor",
     [](const Database& d) { return last(d).signals.size() == 3 && last_signal(d).name == "d"; }},
    {Rule::multiplexor_value,
     message_2("a M : 0|2@1+ (1,0) [0|0] \"\" B\n SG_ c m4 : 16|8@1+ (1,0) [0|0] \"\" B"),
     "9:6 multiplexor-value", [](const Database& d) { return last(d).signals.size() == 2; }},
    {Rule::multiplexing_circle,
     message_2("a m1M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1M : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 a b "
               "1-1;\nSG_MUL_VAL_ 2 b a 1-1;"),
     "8:6 multiplexing-circle, 9:6 multiplexing-circle", has_no_signal},
    {Rule::multiplexor_left_out,
     message_2(
         "a M : 57|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1M : 8|8@1+ (1,0) [0|0] \"\" B\n SG_ c m2 : 16|8@1+ "
         "(1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 b a 1-1;\nSG_MUL_VAL_ 2 c b 2-2;"),
     "8:6 signal-beyond-message, 9:6 multiplexor-left-out, 10:6 multiplexor-left-out", has_no_signal},
    {Rule::indicator_missing,
     message_2("a : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 b a 3-4;"),
     "10:15 indicator-missing, 10:17 indicator-missing",
     [](const Database& d) {
       return last(d).signals[0].multiplexor && last_signal(d).multiplexed_by == "a";
     }},
    {Rule::empty_range,
     message_2("a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 b a "
               "3-1,5-6;"),
     "10:19 empty-range",
     [](const Database& d) {
       const MessagePlan plan(last(d));
       return !plan.is_present(1, std::array<std::uint8_t, 8>{2}) &&
              plan.is_present(1, std::array<std::uint8_t, 8>{5});
     }},
    {Rule::duplicate_multiplexing,
     message_2("a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 8|8@1+ (1,0) [0|0] \"\" B\nSG_MUL_VAL_ 2 b a "
               "3-3;\nSG_MUL_VAL_ 2 b a 4-4;"),
     "11:15 duplicate-multiplexing",
     [](const Database& d) {
       return last_signal(d).mux_ranges == std::vector<MuxRange>{{3, 3}};
     }},
    {Rule::unknown_message, "CM_ BO_ 9 \"x\";\nCM_ \"read\";", "7:9 unknown-message",
     [](const Database& d) { return d.comment == "read"; }},
    {Rule::unknown_signal, "VAL_ 1 x 1 \"x\" ;\nCM_ \"read\";", "7:8 unknown-signal",
     [](const Database& d) { return d.comment == "read"; }},
    {Rule::unknown_variable, "CM_ EV_ x \"x\";\nCM_ \"read\";", "7:9 unknown-variable",
     [](const Database& d) { return d.comment == "read"; }},
    {Rule::duplicate_variable,
     "EV_ e: 0 [0|1] \"\" 0 1 DUMMY_NODE_VECTOR0 A;\nEV_ e: 0 [0|2] \"\" 0 1 DUMMY_NODE_VECTOR0 A;",
     "8:5 duplicate-variable",
     [](const Database& d) { return d.variables.size() == 1 && d.variables[0].maximum == 1; }},
    {Rule::duplicate_table, "VAL_TABLE_ T 1 \"x\" ;\nVAL_TABLE_ T 1 \"y\" ;", "8:12 duplicate-table",
     [](const Database& d) { return d.value_tables.size() == 1; }},
    {Rule::duplicate_value, "VAL_ 1 s 1 \"x\" 1 \"y\" 2 \"z\" ;", "7:16 duplicate-value",
     [](const Database& d) {
       return s_of(d).values == std::vector<ValueName>{{1, "x"}, {2, "z"}};
     }},
    {Rule::duplicate_values, "VAL_ 1 s 1 \"x\" ;\nVAL_ 1 s 2 \"y\" ;", "8:8 duplicate-values",
     [](const Database& d) {
       return s_of(d).values == std::vector<ValueName>{{1, "x"}};
     }},
    {Rule::value_beyond_bits, "VAL_ 1 s 256 \"x\" ;", "4:6 value-beyond-bits",
     [](const Database& d) { return s_of(d).values.size() == 1; }},
    {Rule::values_of_float,
     message_2("a : 0|32@1- (1,0) [0|0] \"\" B\nSIG_VALTYPE_ 2 a : 1;\nVAL_ 2 a 1 \"x\" ;"),
     "8:6 values-of-float", [](const Database& d) { return last_signal(d).values.size() == 1; }},
    {Rule::undefined_attribute, "BA_ \"X\" 1;\nCM_ \"read\";", "7:5 undefined-attribute",
     [](const Database& d) { return d.attributes.empty() && d.comment == "read"; }},
    {Rule::duplicate_definition,
     std::string(integer_attribute) + "BA_DEF_ BO_ \"I\" STRING ;\nBA_ \"I\" BO_ 1 3;",
     "8:13 duplicate-definition", [](const Database& d) { return i_is(d, 3); }},
    {Rule::attribute_owner, std::string(integer_attribute) + "BA_ \"I\" SG_ 1 s 1;\nCM_ \"read\";",
     "8:9 attribute-owner",
     [](const Database& d) { return s_of(d).attributes.empty() && d.comment == "read"; }},
    {Rule::attribute_limits, "BA_DEF_ BO_ \"I\" INT 5 4;\nBA_ \"I\" BO_ 1 9;", "7:21 attribute-limits",
     [](const Database& d) { return i_is(d, 9); }},
    {Rule::attribute_range, std::string(integer_attribute) + "BA_ \"I\" BO_ 1 11;", "8:15 attribute-range",
     [](const Database& d) { return i_is(d, 11); }},
    {Rule::attribute_label, "BA_DEF_ \"E\" ENUM \"x\",\"y\";\nBA_ \"E\" 2;\nCM_ \"read\";",
     "8:9 attribute-label", [](const Database& d) { return d.attributes.empty() && d.comment == "read"; }},
    {Rule::duplicate_default,
     std::string(integer_attribute) + "BA_DEF_DEF_ \"I\" 1;\nBA_DEF_DEF_ \"I\" 2;\nCM_ \"read\";",
     "9:13 duplicate-default",
     [](const Database& d) {
       return d.definitions[0].initial == AttributeValue(std::int64_t{1}) && d.comment == "read";
     }},
    {Rule::duplicate_attribute,
     std::string(integer_attribute) + "BA_ \"I\" BO_ 1 1;\nBA_ \"I\" BO_ 1 2;\nCM_ \"read\";",
     "9:5 duplicate-attribute", [](const Database& d) { return i_is(d, 1) && d.comment == "read"; }},
    {Rule::long_symbol,
     "BA_DEF_ SG_ \"SystemSignalLongSymbol\" STRING ;\nBA_ \"SystemSignalLongSymbol\" SG_ 1 s \"t\";\n"
     "BA_ \"SystemSignalLongSymbol\" SG_ 1 t \"a b\";",
     "4:6 long-symbol, 5:6 long-symbol",
     [](const Database& d) { return s_of(d).name == "s" && last_signal(d).name == "t"; }},
};

std::string places_of(const std::vector<Finding>& findings) {
  std::string places;
  for (const Finding& finding : findings) {
    places += (places.empty() ? "" : ", ") + std::to_string(finding.at.line) + ":" +
              std::to_string(finding.at.column) + " " + std::string(text_of(finding.rule).id);
  }
  return places;
}

class Leniency : public testing::TestWithParam<Lenient> {};

TEST_P(Leniency, TakesTheFileAsTheRuleSays) {
  const Inspection inspection = inspect(first_lines + GetParam().text);
  EXPECT_EQ(places_of(inspection.findings), GetParam().findings);
  ASSERT_TRUE(inspection.database);
  EXPECT_TRUE(GetParam().follows(*inspection.database));
}

TEST_P(Leniency, StrictTakesNotesAlone) {
  const bool is_note = text_of(GetParam().rule).severity == Severity::note;
  EXPECT_EQ(parse(first_lines + GetParam().text, "t.dbc").has_value(), is_note);
}

INSTANTIATE_TEST_SUITE_P(Each, Leniency, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Lenient>& one) {
                           std::string name(text_of(one.param.rule).id);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(LenientReader, FindsNothingInAFileThatIsRight) {
  const auto inspection = inspect_file(SOURCE_DIR "/dbc/canhil.dbc");
  ASSERT_TRUE(inspection);
  EXPECT_THAT(inspection->findings, IsEmpty());
}

TEST(LenientReader, RefusesWhatIsNotADbc) {
  const Inspection inspection = inspect("# A page\nof prose.");
  EXPECT_EQ(places_of(inspection.findings), "1:1 not-a-dbc");
  EXPECT_FALSE(inspection.database);
  const auto database = parse_leniently("# A page\nof prose.", "t.dbc");
  ASSERT_FALSE(database);
  EXPECT_EQ(database.error().message, "t.dbc:1:1: no section of a DBC file, expected one such as BO_");
}

TEST(LenientReader, KeepsTheMessagesAroundWhatItCannotRead) {
  const Inspection inspection = inspect(
      "BU_: A\nSG_ a : 0|8@1+ (1,0) [0|0] \"\" A\nBO_ 2 N: 8 A\n SG_ b : 0|8@1+ (1,0) [0|0] \"\" A\n"
      " BEGIN 1 2\n SG_ c : 8|8@1+ (1,0) [0|0] \"\" A\nBO_ 3 O: 8 A\n");
  EXPECT_EQ(places_of(inspection.findings), "2:1 unreadable-signal, 5:2 unknown-section");
  ASSERT_TRUE(inspection.database);
  ASSERT_EQ(inspection.database->messages.size(), 2U);
  EXPECT_EQ(inspection.database->messages[0].signals.size(), 2U);
}

// Two missing quotes make one long string, which would hide the message between them.
TEST(LenientReader, FindsMessagesBetweenMissingQuotes) {
  const Inspection inspection = inspect(
      "BU_: A\nCM_ \"x;\nBO_ 2 N: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\nCM_ BO_ 2 \"y;\nBO_ 3 O: 8 A\n");
  EXPECT_EQ(places_of(inspection.findings),
            "2:5 unfinished-string, 5:11 unfinished-string, 3:1 missing-semicolon, 6:1 missing-semicolon");
  ASSERT_TRUE(inspection.database);
  EXPECT_EQ(inspection.database->messages.size(), 2U);
  // A comment may contain the text of a section.
  const Inspection comment = inspect("BU_: A\nBO_ 2 N: 8 A\nCM_ BO_ 2 \"before:\nBO_ 2 N: 4 A\n\";\n");
  EXPECT_TRUE(comment.findings.empty());
  EXPECT_EQ(comment.database->messages[0].comment, "before:\nBO_ 2 N: 4 A\n");
}

// PGN 129540 (satellites in view) is a fast packet. PGN 65227 (trouble codes) is a message of J1939.
TEST(LenientReader, KeepsLongMessagesOfTransportProtocols) {
  const Inspection inspection = inspect(
      "BU_: A\nBO_ 2381842434 Sats: 223 A\n SG_ last : 1776|8@1+ (1,0) [0|0] \"\" A\n"
      "BO_ 2566834944 Codes: 1785 A\n SG_ Code : 14272|8@1+ (1,0) [0|0] \"\" A\n SG_ Beyond : 14279|8@1+ "
      "(1,0) [0|0] \"\" A\n"
      "BO_ 2566835200 Other: 100 A\n"
      "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\",\"J1939PG\";\n"
      "BA_DEF_DEF_ \"VFrameFormat\" \"ExtendedCAN\";\nBA_ \"VFrameFormat\" BO_ 2566834944 3;\n");
  ASSERT_TRUE(inspection.database);
  const auto& messages = inspection.database->messages;
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_TRUE(messages[0].fast_packet);
  EXPECT_EQ(messages[0].signals.size(), 1U);
  EXPECT_TRUE(messages[1].j1939_transport());
  EXPECT_EQ(messages[1].signals.size(), 1U);
  EXPECT_EQ(places_of(inspection.findings), "6:6 signal-beyond-message, 7:5 message-size");
  EXPECT_EQ(places_of(inspect("BU_: A\nBO_ 2 N: 1786 A\n").findings), "2:10 message-size");
}

TEST(LenientReader, ListsTenThousandFindingsAndReadsOn) {
  const Inspection inspection = inspect("BU_: A\n" + std::string(20'000, '%') + "\nBO_ 3 O: 8 A\n");
  ASSERT_TRUE(inspection.database);
  EXPECT_EQ(inspection.database->messages.size(), 1U);
  EXPECT_EQ(inspection.findings.size(), 10'001U);
  EXPECT_EQ(inspection.findings.back().rule, Rule::too_many_findings);
}

TEST(Rules, EachHasACaseOrRefusesTheFile) {
  std::set<Rule> covered{Rule::too_many_findings};  // ListsTenThousandFindingsAndReadsOn
  for (const Lenient& one : cases) covered.insert(one.rule);
  std::set<std::string_view> ids;
  for (const RuleText& rule : rule_texts()) {
    EXPECT_EQ(covered.contains(rule.rule), rule.severity != Severity::error) << rule.id;
    EXPECT_TRUE(ids.insert(rule.id).second) << rule.id;
  }
}

}  // namespace
}  // namespace canhil::dbc
