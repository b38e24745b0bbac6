#include "dbc/parser/lexer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace canhil::dbc {
namespace {

constexpr std::array<std::string_view, 27> keywords{"VERSION",      "NS_",
                                                    "BS_",          "BU_",
                                                    "BO_",          "SG_",
                                                    "BO_TX_BU_",    "EV_",
                                                    "ENVVAR_DATA_", "CM_",
                                                    "BA_DEF_",      "BA_",
                                                    "BA_DEF_DEF_",  "BA_DEF_REL_",
                                                    "BA_REL_",      "BA_DEF_DEF_REL_",
                                                    "VAL_",         "VAL_TABLE_",
                                                    "SIG_GROUP_",   "SIG_VALTYPE_",
                                                    "SG_MUL_VAL_",  "SIGTYPE_VALTYPE_",
                                                    "SGTYPE_",      "SIG_TYPE_REF_",
                                                    "BU_SG_REL_",   "BU_BO_REL_",
                                                    "BU_EV_REL_"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }
bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

class Lexer {
 public:
  Lexer(std::string_view text, Findings& findings, StringEnd end)
      : text_(text), findings_(findings), end_(end) {}

  [[nodiscard]] bool string_spans_section() const { return string_spans_section_; }

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
      if (keyword_follows()) {
        string_spans_section_ = true;
        if (end_ == StringEnd::quote_or_section) break;
      }
      char c = take();
      if (c == '\r') continue;
      if (c == '\\' && (peek() == '"' || peek() == '\\')) c = take();
      text += c;
    }
    if (peek() == '"') {
      take();
    } else {
      string_spans_section_ = true;
      findings_.add(Rule::unfinished_string, start,
                    "string without end, expected '\"' before the next section");
    }
    return text;
  }
  /// True at the end of a line if the next line begins with a keyword.
  [[nodiscard]] bool keyword_follows() const {
    if (peek() != '\n') return false;
    std::string_view line = text_.substr(index_ + 1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const auto end = std::ranges::find_if(line, [](char c) { return !is_letter(c); });
    return is_keyword(line.substr(0, static_cast<std::size_t>(end - line.begin())));
  }

  std::string_view text_;
  Findings& findings_;
  StringEnd end_;
  bool string_spans_section_ = false;
  std::size_t index_ = 0;
  Position at_;
};

}  // namespace

bool is_keyword(std::string_view word) { return std::ranges::find(keywords, word) != keywords.end(); }

Tokens tokens_of(std::string_view text, Findings& findings, StringEnd end) {
  Lexer lexer(text, findings, end);
  Tokens tokens;
  do {
    tokens.all.push_back(lexer.next());
  } while (tokens.all.back().kind != TokenKind::end);
  tokens.string_spans_section = lexer.string_spans_section();
  return tokens;
}

}  // namespace canhil::dbc
