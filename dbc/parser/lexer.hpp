// Splits the text of a DBC into tokens. This header is internal to the parser.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// An exception that ends the reading of a section. The parser always catches the exception and continues
/// with the next section.
struct SectionFailure {
  Position at;
  std::string what;
  Rule rule = Rule::unreadable_section;
};

[[noreturn]] inline void fail_at(Rule rule, Position at, std::string what) {
  throw SectionFailure{at, std::move(what), rule};
}

enum class TokenKind : unsigned char { word, number, string, mark, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< of a string: without the quotes and with escapes resolved
  Position at;
};

/// Whether a word is a keyword of the format, such as BO_.
bool is_keyword(std::string_view word);

/// Where a string ends: at its closing quote, or also before a line that begins with a keyword. The second
/// finds the end of a string that lacks its closing quote; but a comment may contain such a line.
enum class StringEnd : unsigned char { quote, quote_or_section };

struct Tokens {
  std::vector<Token> all;  ///< the last token has the kind `end`
  /// A string has no end, or contains a line that begins with a keyword.
  bool string_spans_section = false;
};

/// The tokens of a UTF-8 text. An unexpected character becomes a token of the kind `mark`.
Tokens tokens_of(std::string_view text, Findings& findings, StringEnd end = StringEnd::quote);

}  // namespace canhil::dbc
