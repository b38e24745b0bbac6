// The encodings of a DBC text.
#include "dbc/parser/encoding.hpp"

#include <gtest/gtest.h>

#include "dbc/parser/parse.hpp"

namespace canhil::dbc {
namespace {

std::string to_utf8(std::string_view text, const std::string& encoding = {}) {
  Findings findings;
  return dbc::to_utf8(text, encoding, findings);
}

TEST(ToUtf8, LeavesUtf8AndReadsTheRestAsWindows1252) {
  EXPECT_EQ(to_utf8("\xEF\xBB\xBF\xC2\xB0"), "\xC2\xB0");
  EXPECT_EQ(to_utf8("\xB0\x80\x96"), "\xC2\xB0\xE2\x82\xAC\xE2\x80\x93");
  EXPECT_EQ(to_utf8("\x81"), "\xEF\xBF\xBD");
  EXPECT_EQ(to_utf8("\xC2"), "\xC3\x82");                  // an incomplete sequence is not UTF-8
  EXPECT_EQ(to_utf8("\xC0\x80"), "\xC3\x80\xE2\x82\xAC");  // an overlong sequence is not UTF-8 either
  EXPECT_EQ(to_utf8(std::string(100'000, '\xB0')).size(), 200'000U);
}

TEST(ToUtf8, ReadsTheEncodingThatIsGiven) {
  EXPECT_EQ(to_utf8("\x95\x5C", "shift_jis"), "\xE8\xA1\xA8");
  EXPECT_EQ(to_utf8("\xC2\xB0", "cp1252"), "\xC3\x82\xC2\xB0");
  EXPECT_EQ(to_utf8(std::string_view("\xFF\xFE"
                                     "B\0\xB0\0",
                                     6)),
            "B\xC2\xB0");
  EXPECT_EQ(to_utf8(std::string_view("\xFE\xFF\0B\0\xB0", 6)), "B\xC2\xB0");
  EXPECT_TRUE(is_encoding("SHIFT_JIS"));
  for (const char* name : {"", "nonsense", "utf-8//IGNORE", "ascii/"})
    EXPECT_FALSE(is_encoding(name)) << name;
}

TEST(ToUtf8, SaysWhereTheFirstBadBytesAre) {
  Findings findings;
  EXPECT_EQ(dbc::to_utf8("a\n\xC3\xA4\xC3\xA4\xFF\xFE"
                         "b",
                         "utf-8", findings),
            "a\n\xC3\xA4\xC3\xA4\xEF\xBF\xBD\xEF\xBF\xBD"
            "b");
  ASSERT_EQ(findings.all().size(), 1U);
  EXPECT_EQ(findings.all()[0].rule, Rule::text_encoding);
  EXPECT_EQ(findings.all()[0].at.line, 2);
  EXPECT_EQ(findings.all()[0].at.column, 3);
}

// The second byte of some characters of Shift-JIS is a backslash. Before the closing quote, it must not
// escape this quote.
TEST(Inspect, ReadsStringsThatEndWithABackslashOfTwoByteCharacters) {
  const std::string text =
      "BU_: A\nBO_ 1 M: 8 A\n SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\nCM_ SG_ 1 s \"\x90\xAB\x94\x5C\";\nCM_ "
      "\"x\";\n";
  const Inspection guessed = inspect(text);
  ASSERT_TRUE(guessed.database);
  EXPECT_EQ(guessed.findings.size(), 1U) << "of the encoding";
  EXPECT_EQ(guessed.database->comment, "x");
  EXPECT_EQ(guessed.database->hash, hash(text));
  const Inspection told = inspect(text, "shift_jis");
  ASSERT_TRUE(told.database);
  EXPECT_EQ(told.database->messages[0].signals[0].comment, "\xE6\x80\xA7\xE8\x83\xBD");
  // In Windows-1252, the same backslash is an escape.
  const Inspection windows = inspect("BO_ 1 M: 8 A\nCM_ BO_ 1 \"\xDF\\\" x\";\nCM_ \"y\";\n");
  ASSERT_TRUE(windows.database);
  EXPECT_EQ(windows.database->messages[0].comment, "\xC3\x9F\" x");
  EXPECT_EQ(windows.database->comment, "y");
}

}  // namespace
}  // namespace canhil::dbc
