#include "dbc/parser/lexer.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace canhil::dbc {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }
bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

class Lexer {
 public:
  Lexer(std::string_view text, Findings& findings) : text_(text), findings_(findings) {}

  Token next() {
    skip_space();
    Token token{TokenKind::end, {}, at_};
    if (at_end()) return token;
    const char c = peek();
    if (c == '"') {
      token.kind = TokenKind::string;
      token.text = string(token.at);
    } else if (is_letter(c) || !is_ascii(c)) {
      token.kind = TokenKind::word;
      token.text = word();
    } else if (starts_number()) {
      token.kind = TokenKind::number;
      token.text = number();
    } else if (std::string_view(":;|@()[],+-").find(c) != std::string_view::npos) {
      token.kind = TokenKind::mark;
      token.text = take();
    } else {
      report(Rule::unexpected_character);
      token.kind = TokenKind::mark;
      token.text = take();
    }
    return token;
  }

 private:
  [[nodiscard]] bool at_end() const { return index_ >= text_.size(); }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return index_ + ahead < text_.size() ? text_[index_ + ahead] : '\0';
  }
  char take() {
    const char c = text_[index_++];
    if (c == '\n') {
      ++at_.line;
      at_.column = 1;
    } else if (!is_continuation(c)) {
      ++at_.column;
    }
    return c;
  }
  void report(Rule rule) {
    findings_.add(rule, at_,
                  "unexpected character " + printable(peek()) +
                      ", expected a keyword, a name, a number, a string or punctuation");
  }
  void skip_space() {
    while (!at_end()) {
      if (is_space(peek())) {
        take();
      } else if (peek() == '/' && peek(1) == '/') {
        report(Rule::line_comment);
        while (!at_end() && peek() != '\n') take();
      } else {
        return;
      }
    }
  }
  std::string word() {
    std::string text;
    bool reported = false;
    while (!at_end() && (is_letter(peek()) || is_digit(peek()) || !is_ascii(peek()))) {
      if (!is_ascii(peek()) && !std::exchange(reported, true)) report(Rule::name_character);
      text += take();
    }
    return text;
  }
  static std::string printable(char c) {
    const auto code = static_cast<unsigned char>(c);
    if (code > 0x20 && code < 0x7F) return std::string("'") + c + "'";
    constexpr std::string_view digits = "0123456789ABCDEF";
    return std::string("0x") + digits[code >> 4U] + digits[code & 15U];
  }

  // A '-' or '+' belongs to a number only if a digit follows. In "@1- (" no digit follows: there the '-'
  // means that the signal is signed.
  [[nodiscard]] bool starts_number() const {
    const std::size_t sign = (peek() == '-' || peek() == '+') ? 1 : 0;
    const std::size_t dot = peek(sign) == '.' ? 1 : 0;
    return is_digit(peek(sign + dot));
  }
  std::string number() {
    std::string text;
    if (peek() == '-' || peek() == '+') text += take();
    while (is_digit(peek())) text += take();
    if (peek() == '.') text += take();
    while (is_digit(peek())) text += take();
    if (peek() == 'e' || peek() == 'E') {
      const std::size_t sign = (peek(1) == '-' || peek(1) == '+') ? 1 : 0;
      if (is_digit(peek(1 + sign))) {
        for (std::size_t i = 0; i < 1 + sign; ++i) text += take();
        while (is_digit(peek())) text += take();
      }
    }
    return text;
  }
  // Reads a string. A backslash escapes a quote or a backslash; before any other character it is an ordinary
  // character. Line breaks become \n.
  std::string string(Position start) {
    std::string text;
    take();
    while (!at_end() && peek() != '"') {
      char c = take();
      if (c == '\r') continue;
      if (c == '\\' && (peek() == '"' || peek() == '\\')) c = take();
      text += c;
    }
    if (at_end()) {
      findings_.add(Rule::unfinished_string, start,
                    "string without end, expected '\"' before the end of the file");
    } else {
      take();
    }
    return text;
  }

  std::string_view text_;
  Findings& findings_;
  std::size_t index_ = 0;
  Position at_;
};

/// The length of the UTF-8 sequence with which `text` begins; 0: `text` does not begin with a valid sequence.
std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80                     ? 1
                             : (lead >= 0xC2 && lead < 0xE0) ? 2
                             : (lead & 0xF0U) == 0xE0        ? 3
                             : (lead >= 0xF0 && lead < 0xF5) ? 4
                                                             : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  return length;
}

void append_utf8(std::string& out, std::uint32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0U | (code >> 6U));
    out += static_cast<char>(0x80U | (code & 0x3FU));
  } else {
    out += static_cast<char>(0xE0U | (code >> 12U));
    out += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
    out += static_cast<char>(0x80U | (code & 0x3FU));
  }
}

// The characters of the bytes 0x80..0x9F in Windows-1252; all other bytes are as in Latin-1. A byte that has
// no character becomes U+FFFD.
constexpr std::array<std::uint16_t, 32> cp1252_high{
    0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, Findings& findings) {
  Lexer lexer(text, findings);
  std::vector<Token> tokens;
  do {
    tokens.push_back(lexer.next());
  } while (tokens.back().kind != TokenKind::end);
  return tokens;
}

std::string to_utf8(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (!first_not_utf8(text)) return std::string(text);
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? cp1252_high[byte - 0x80U] : byte);
  }
  return out;
}

std::optional<Position> first_not_utf8(std::string_view text) {
  Position at;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return at;
    at = text[0] == '\n' ? Position{at.line + 1, 1} : Position{at.line, at.column + 1};
    text.remove_prefix(length);
  }
  return std::nullopt;
}

}  // namespace canhil::dbc
