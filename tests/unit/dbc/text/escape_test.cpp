#include "dbc/text/escape.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <string>

namespace canhil {
namespace {

std::string utf8(std::uint32_t code) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  const char last = byte(0x80U | (code & 0x3FU));
  if (code < 0x800) return {byte(0xC0U | code >> 6U), last};
  const char third = byte(0x80U | (code >> 6U & 0x3FU));
  if (code < 0x10000) return {byte(0xE0U | code >> 12U), third, last};
  return {byte(0xF0U | code >> 18U), byte(0x80U | (code >> 12U & 0x3FU)), third, last};
}

TEST(Escape, MakesWhatControlsATerminalVisible) {
  EXPECT_EQ(for_terminal("a\x1b[31mb\n\tc"), "a\\x1b[31mb\n\tc");
  EXPECT_EQ(one_line("a\nb\tc\rd\x7f"), "a\\nb\\tc\\rd\\x7f");
  EXPECT_EQ(one_line("\u0085\u009b31m"), "\\u0085\\u009b31m");
  EXPECT_EQ(one_line("\u202egnp.exe\u2066\u200f\u061c"), "\\u202egnp.exe\\u2066\\u200f\\u061c");
  EXPECT_EQ(one_line("\u2028\u2029\ufeff"), "\\u2028\\u2029\\ufeff");
  EXPECT_EQ(one_line(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(one_line("\U000e0041"), "\\U000e0041");
}

TEST(Escape, KeepsTextOfAllLanguages) {
  for (const char* text :
       {"Neigung 3 \u00b0/s", "\u4fef\u4ef0\u89d2", "\u0430\u0431", "\u2264 \u03bc", "\U0001F681", "C:\\x"})
    for (const auto& escaped : {for_terminal(text), one_line(text), for_markup(text), for_csv(text)})
      EXPECT_EQ(escaped, text);
}

TEST(Escape, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(one_line("3 \xb0/s"), "3 \\xb0/s");                              // Latin-1
  EXPECT_EQ(one_line("\xc0\xaf\xe0\x80\xaf"), "\\xc0\\xaf\\xe0\\x80\\xaf");  // overlong
  EXPECT_EQ(one_line("\xed\xa0\x80"), "\\xed\\xa0\\x80");                    // a surrogate
  EXPECT_EQ(one_line("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");           // beyond U+10FFFF
  EXPECT_EQ(one_line("a\xe2\x82"), "a\\xe2\\x82");                           // cut off
  EXPECT_EQ(one_line("\xc2\x9b"), "\\u009b");
}

TEST(Escape, WritesMarkupThatXmlPermits) {
  EXPECT_EQ(for_markup("<a b=\"c\">&\n"), "&lt;a b=&quot;c&quot;&gt;&amp; ");
  for (std::uint32_t code = 0; code <= 0x10FFFF; ++code) {
    if (code >= 0xD800 && code <= 0xDFFF) continue;
    // Production [2] of XML 1.0, without the characters that it discourages.
    const bool permitted = code >= 0x20 && (code & 0xFFFEU) != 0xFFFE && !(code >= 0x7F && code <= 0x9F) &&
                           !(code >= 0xFDD0 && code <= 0xFDEF);
    const std::string own = utf8(code), escaped = for_markup("x" + own);
    if (!permitted) {
      EXPECT_EQ(escaped.find(own), std::string::npos) << code;
    }
  }
}

TEST(Escape, KeepsACellOfATableTogether) {
  EXPECT_EQ(for_csv("plain"), "plain");
  EXPECT_EQ(for_csv("a,b"), "\"a,b\"");
  EXPECT_EQ(for_csv("say \"a\""), "\"say \"\"a\"\"\"");
  EXPECT_EQ(for_csv("a\nb\x1b"), "a\\nb\\x1b");
  EXPECT_EQ(for_csv("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(for_csv("-1,2"), "\"'-1,2\"");
}

}  // namespace
}  // namespace canhil
