#include "dbc/parser/lexer.hpp"

#include <gtest/gtest.h>

namespace canhil::dbc {
namespace {

std::vector<Token> tokens_of(std::string_view text) {
  Findings findings;
  auto tokens = dbc::tokens_of(text, findings);
  EXPECT_TRUE(findings.all().empty());
  EXPECT_FALSE(tokens.string_spans_section);
  return tokens.all;
}

TEST(Lexer, ASignIsOfTheNumberOnlyBeforeADigit) {
  const auto tokens = tokens_of("@1- (-2.5E-3,+.5)");
  const std::vector<std::string> expected{"@", "1", "-", "(", "-2.5E-3", ",", "+.5", ")", ""};
  ASSERT_EQ(tokens.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(tokens[i].text, expected[i]);
  EXPECT_EQ(tokens.back().kind, TokenKind::end);
}

TEST(Lexer, StringsHoldEscapesAndLineBreaks) {
  const auto tokens = tokens_of("\"a \\\"b\\\" \\\\ \\n\r\nc\"");
  EXPECT_EQ(tokens[0].kind, TokenKind::string);
  EXPECT_EQ(tokens[0].text, "a \"b\" \\ \\n\nc");
}

TEST(Lexer, CountsLinesAndCharacters) {
  const auto tokens = tokens_of("a\r\n  \"\xC3\xA4\" b");
  EXPECT_EQ(tokens[1].at.line, 2);
  EXPECT_EQ(tokens[1].at.column, 3);
  EXPECT_EQ(tokens[2].at.column, 7);  // the umlaut is one character
}

}  // namespace
}  // namespace canhil::dbc
