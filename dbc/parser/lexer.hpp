// DBC text to tokens. Internal to the parser.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Leaves the parser from any depth; parse() turns it into a Result. Never seen outside.
struct ParseFailure {
  Position at;
  std::string what;
};

[[noreturn]] inline void fail_at(Position at, std::string what) { throw ParseFailure{at, std::move(what)}; }

enum class TokenKind : unsigned char { word, number, string, mark, end };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< strings: without quotes, escapes resolved
  Position at;
};

/// Tokens of UTF-8 text, the last one of kind end. Throws ParseFailure.
std::vector<Token> tokens_of(std::string_view text);

/// The text as UTF-8: unchanged if it is, else taken for Windows-1252. A byte order mark is dropped.
std::string to_utf8(std::string_view text);

}  // namespace canhil::dbc
