// Splits the text of a DBC into tokens. This header is internal to the parser.
#pragma once

#include <optional>
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

/// The tokens of a UTF-8 text; the last token has the kind `end`. An unexpected character becomes a token of
/// the kind `mark`.
std::vector<Token> tokens_of(std::string_view text, Findings& findings);

/// Returns the text as UTF-8, without a byte order mark. If the text is not valid UTF-8, converts it from
/// Windows-1252.
std::string to_utf8(std::string_view text);

/// The position of the first byte that is not part of a valid UTF-8 character; nullopt: there is no such
/// byte.
std::optional<Position> first_not_utf8(std::string_view text);

}  // namespace canhil::dbc
