// DBC text to tokens. Internal to the parser.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/parser/finding.hpp"

namespace canhil::dbc {

/// Exception that leaves a section from any depth of calls. The parser always catches it and continues with
/// the next section.
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
  std::string text;  ///< strings: without quotes, escapes resolved
  Position at;
};

/// Tokens of UTF-8 text, the last one of kind end. An unexpected character becomes a mark token.
std::vector<Token> tokens_of(std::string_view text, Findings& findings);

/// The text as UTF-8; text that is not UTF-8 is converted from Windows-1252. A byte order mark is dropped.
std::string to_utf8(std::string_view text);

/// The first byte that is not part of a valid UTF-8 character, if there is one.
std::optional<Position> first_not_utf8(std::string_view text);

}  // namespace canhil::dbc
