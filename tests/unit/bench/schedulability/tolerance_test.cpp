// Which warnings about a DBC the analysis tolerates.
#include "bench/schedulability/tolerance.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/schedulability/message_set.hpp"
#include "bench/schedulability/report.hpp"

namespace canhil::schedulability {
namespace {

using testing::HasSubstr;

// Seven lines, so that the text of each case begins in line 8.
constexpr const char* head =
    "BU_: A\nBO_ 1 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\nBA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 1000;\n"
    "BA_DEF_ SG_ \"Other\" INT 0 10;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\nBA_ \"GenMsgCycleTime\" BO_ 1 "
    "10;\n";

struct Case {
  const char* name;
  std::string text;
  const char* refused;  ///< the error after "t.dbc:"; empty: the DBC is analysed
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Tolerance : public testing::TestWithParam<Case> {};

TEST_P(Tolerance, RefusesWhatTouchesTiming) {
  const auto all = tolerated(dbc::inspect(head + GetParam().text), "t.dbc");
  const std::string error = all ? "" : all.error().message;
  EXPECT_EQ(error, std::string(GetParam().refused).empty() ? "" : std::string("t.dbc:") + GetParam().refused);
  if (all) {
    EXPECT_FALSE(all->empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, Tolerance,
    testing::Values(Case{"receiver", "BO_ 2 N: 8 A\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X\n", ""},
                    Case{"sender", "BO_ 2 N: 8 X\n", ""},
                    Case{"signal", "BO_ 2 N: 8 A\n SG_ s m : 0|8@1+ (1,0) [0|0] \"\" A\n", ""},
                    Case{"values", "VAL_ 1 s 256 \"x\" ;", ""},
                    Case{"other_attribute", "BA_ \"Undefined\" 1;\nBA_ \"Other\" SG_ 1 s \"x\";", ""},
                    Case{"comment", "CM_ SG_ 1 \"x\";", ""},
                    Case{"other_message", "BA_ \"GenMsgCycleTime\" BO_ 9 10;", ""},
                    Case{"above_the_maximum", "BO_ 2 N: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 2 2000;", ""},
                    Case{"message_of_9_bytes", "BO_ 2 N: 9 A\n", ""},
                    Case{"message", "BO_ 2 : 8 A\n", "8:7: unexpected ':', expected the name of the message"},
                    Case{"same_id", "BO_ 1 N: 8 A\n",
                         "8:5: message N has the id 1 of M, expected a unique id"},
                    Case{"cycle_time", "BO_ 2 N: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 2 -1;",
                         "8:5: message N has GenMsgCycleTime -1 ms, expected 0 (none) or 0.001..1e9"},
                    Case{"cycle_time_text", "BA_ \"GenMsgCycleTime\" BO_ 1 x;",
                         "8:29: unexpected 'x', expected a value, an integer"},
                    Case{"cycle_time_fraction", "BO_ 2 N: 8 A\nBA_ \"GenMsgCycleTime\" BO_ 2 0.5;",
                         "9:29: unexpected '0.5', expected a value, an integer"},
                    Case{"deadline_undefined", "BA_ \"GenMsgDeadline\" BO_ 1 5;",
                         "8:5: attribute \"GenMsgDeadline\" is not defined, expected a BA_DEF_ above"},
                    Case{"attribute_unknown", "BA_ 7;",
                         "8:5: unexpected '7', expected the name of the attribute in quotes"}),
    [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

TEST(Tolerance, IsReportedWithWhatIsAssumed) {
  const std::string text = std::string(head) + "BO_ 2 N: 8 A\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" X,Y\n";
  const auto inspection = dbc::inspect(text);
  auto all = tolerated(inspection, "t.dbc");
  ASSERT_TRUE(all);
  const wire::BitRates rates{.nominal = 500'000};
  auto streams = streams_of(*inspection.database, {}, rates);
  ASSERT_TRUE(streams);
  Analysis analysis = analyse("t.dbc", std::move(*streams), {.rates = rates});
  analysis.tolerated = std::move(*all);
  EXPECT_THAT(
      table(analysis),
      HasSubstr("warning undeclared-node, 2 times, first in line 9: no node 'X', expected one listed in "
                "BU_\n  assumed: the name is kept, a section about the node is left out\n"));
  const auto warning = nlohmann::json::parse(json(analysis))["warnings"][0];
  EXPECT_EQ(warning["rule"], "undeclared-node");
  EXPECT_EQ(warning["count"], 2);
  EXPECT_EQ(warning["first_line"], 9);
  EXPECT_EQ(warning["assumed"], "the name is kept, a section about the node is left out");
}

// The bus carries a message of 10 bytes in a frame of 12.
TEST(Streams, HaveTheSizeOfTheFrameOnTheBus) {
  const std::string formats =
      "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"StandardCAN_FD\";\nBA_DEF_DEF_ \"VFrameFormat\" "
      "\"StandardCAN_FD\";\n";
  const auto bits = [&](const std::string& size) {
    const auto inspection = dbc::inspect("BU_: A\nBO_ 1 M: " + size + " A\n" + formats);
    return streams_of(*inspection.database, {}, {.nominal = 500'000, .data = 2'000'000})
        ->front()
        .length.bits();
  };
  EXPECT_EQ(bits("10"), bits("12"));
  EXPECT_GT(bits("10"), bits("8"));
}

TEST(Streams, OfJ1939HaveOneFrame) {
  const auto inspection = dbc::inspect(
      "BU_: A\nBO_ 2566844926 M: 20 A\nBA_DEF_ \"ProtocolType\" STRING ;\nBA_ \"ProtocolType\" \"J1939\";\n");
  const auto streams = streams_of(*inspection.database, {}, {.nominal = 500'000});
  ASSERT_FALSE(streams);
  EXPECT_EQ(streams.error().message,
            "message M has 20 bytes, which SAE J1939 sends in several frames, expected at most 8");
}

}  // namespace
}  // namespace canhil::schedulability
