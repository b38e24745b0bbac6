// The lenient reader and lists: a malformed entry of a section does not cost the other entries.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

// Six lines, so that the text of each case begins in line 7.
constexpr const char* before_entries =
    "BS_:\nBU_: A B\nBO_ 1 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|255] \"\" B\n SG_ t : 8|8@1- (1,0) [0|0] \"\" "
    "B\n\n";

const Message& last_message(const Database& database) { return database.messages.back(); }

std::string entry_findings(const std::vector<Finding>& findings) {
  std::string all;
  for (const Finding& one : findings) {
    all +=
        fmt::format("{}{}:{} {}", all.empty() ? "" : ", ", one.at.line, one.at.column, text_of(one.rule).id);
  }
  return all;
}

// A text, the findings about its one malformed entry, and what is there nevertheless.
struct OneBadEntry {
  std::string name, text, findings;
  bool (*others)(const Database&);
};

const OneBadEntry bad_entries[] = {
    {"value_table", "VAL_TABLE_ T 1 \"x\" y 2 \"z\" ;", "7:20 unreadable-entry",
     [](const Database& d) { return d.value_tables[0].values.size() == 2; }},
    {"variable_values", "EV_ e: 0 [0|1] \"\" 0 1 DUMMY_NODE_VECTOR0 A,5,B;\nVAL_ e 1 \"x\" 2 3 \"z\";",
     "7:44 unreadable-entry, 8:16 unreadable-entry",
     [](const Database& d) { return d.variables[0].nodes.size() == 2 && d.variables[0].values.size() == 2; }},
    {"signal_group", "SIG_GROUP_ 1 g 1 : s 5 x t;", "7:22 unreadable-entry, 7:24 unknown-signal",
     [](const Database& d) {
       return d.messages[0].groups[0].signals == std::vector<std::string>{"s", "t"};
     }},
    {"ranges",
     "BO_ 2 N: 8 A\n SG_ a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 8|8@1+ (1,0) [0|0] \"\" B\n"
     "SG_MUL_VAL_ 2 b a 1-2, x-4, 7-8;",
     "10:24 unreadable-entry",
     [](const Database& d) {
       return last_message(d).signals.back().mux_ranges == std::vector<MuxRange>{{1, 2}, {7, 8}};
     }},
    {"ranges_all",
     "BO_ 2 N: 8 A\n SG_ a M : 0|8@1+ (1,0) [0|0] \"\" B\n SG_ b m1 : 8|8@1+ (1,0) [0|0] \"\" B\n"
     "SG_MUL_VAL_ 2 b a x;",
     "10:19 unreadable-entry",
     [](const Database& d) {
       return last_message(d).signals.back().mux_ranges == std::vector<MuxRange>{{1, 1}};
     }},
    {"nodes", "BU_: C, 5 D", "7:7 unreadable-entry", [](const Database& d) { return d.nodes.size() == 4; }},
    {"receivers",
     "BO_ 2 N: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" A,,B\n SG_ b : 8|8@1+ (1,0) [0|0] \"\" A,\n",
     "8:34 unreadable-entry, 10:1 missing-node",
     [](const Database& d) {
       return last_message(d).signals.size() == 2 && last_message(d).signals[0].receivers.size() == 2;
     }},
    {"senders", "BO_TX_BU_ 1 : A,3,B;", "7:17 unreadable-entry",
     [](const Database& d) { return d.messages[0].further_senders == std::vector<std::string>{"B"}; }},
    {"labels", "BA_DEF_ BO_ \"E\" ENUM \"x\",,\"y\";\nBA_ \"E\" BO_ 1 2;", "7:26 unreadable-entry",
     [](const Database& d) { return d.messages[0].attributes.at("E") == AttributeValue(std::string("y")); }},
    {"limits", "BA_DEF_ BO_ \"I\" INT 3 x;\nBA_ \"I\" BO_ 1 9;", "7:23 unreadable-entry",
     [](const Database& d) { return d.messages[0].attributes.at("I") == AttributeValue(std::int64_t{9}); }},
};

TEST(LenientReader, KeepsTheOtherEntriesOfAList) {
  for (const OneBadEntry& one : bad_entries) {
    SCOPED_TRACE(one.name);
    const Inspection inspection = inspect(before_entries + one.text);
    EXPECT_EQ(entry_findings(inspection.findings), one.findings);
    ASSERT_TRUE(inspection.database);
    EXPECT_TRUE(one.others(*inspection.database));
  }
}

}  // namespace
}  // namespace canhil::dbc
