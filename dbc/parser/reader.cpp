#include "dbc/parser/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace canhil::dbc {
namespace {

std::string shown(const Token& token) {
  switch (token.kind) {
    case TokenKind::end:
      return "the end of the file";
    case TokenKind::string:
      return fmt::format("\"{}\"", token.text);
    default:
      return fmt::format("'{}'", token.text);
  }
}

std::string unexpected(const Token& token, std::string_view expected) {
  return fmt::format("unexpected {}, expected {}", shown(token), expected);
}

std::string undeclared(std::string_view node) {
  return fmt::format("no node '{}', expected one listed in BU_", node);
}

template <class Number>
bool read_all(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

void Reader::fail(const std::string& expected) const {
  throw SectionFailure{peek().at, unexpected(peek(), expected)};
}

void Reader::report(Rule rule, const std::string& expected) {
  findings_.add(rule, peek().at, unexpected(peek(), expected));
}

bool Reader::at_section() const {
  const Token& token = peek();
  return token.kind == TokenKind::word && is_keyword(token.text) && token.text != "SG_" &&
         (index_ == 0 || tokens_[index_ - 1].at.line != token.at.line);
}

// True if the next two tokens together are a name that begins with a digit, such as "2017_5". The lexer reads
// this name as the number 2017 and the word _5.
bool Reader::at_name_with_digit() const {
  const Token& digits = peek();
  const Token& rest = peek(1);
  return digits.kind == TokenKind::number && rest.kind == TokenKind::word &&
         digits.text.find_first_not_of("0123456789") == std::string::npos && rest.at.line == digits.at.line &&
         rest.at.column == digits.at.column + static_cast<int>(digits.text.size());
}

bool Reader::take_mark_if(char mark) {
  if (!at_mark(mark)) return false;
  take();
  return true;
}

void Reader::mark(char mark) {
  if (!take_mark_if(mark)) fail(fmt::format("'{}'", mark));
}

void Reader::semicolon() {
  if (take_mark_if(';')) return;
  if (!at_section_end()) fail("';'");
  report(Rule::missing_semicolon, "';'");
}

std::string Reader::word(std::string_view what) {
  if (at_name_with_digit()) {
    report(Rule::name_begins_with_digit, std::string(what));
    const std::string digits = take().text;
    return digits + take().text;
  }
  if (!at_name()) fail(std::string(what));
  return take().text;
}

std::string Reader::string(std::string_view what) {
  if (peek().kind != TokenKind::string) fail(fmt::format("{} in quotes", what));
  return take().text;
}

double Reader::real(std::string_view what) {
  double value = 0;
  if (peek().kind != TokenKind::number || !read_all(peek().text, value)) fail(std::string(what));
  take();
  return value;
}

std::int64_t Reader::integer(std::string_view what) {
  std::int64_t value = 0;
  if (peek().kind != TokenKind::number || !read_all(peek().text, value))
    fail(fmt::format("{}, an integer", what));
  take();
  return value;
}

RawNumber Reader::raw_number(std::string_view what) {
  const std::string_view text = peek().text;
  const bool is_negative = text.starts_with('-');
  const std::string_view digits = text.substr(is_negative || text.starts_with('+') ? 1 : 0);
  if (peek().kind != TokenKind::number || digits.find_first_not_of("0123456789") != std::string_view::npos)
    fail(fmt::format("{}, an integer", what));
  RawNumber value = 0;
  for (const char digit : digits) {
    if (__builtin_mul_overflow(value, 10, &value) || __builtin_add_overflow(value, digit - '0', &value)) {
      constexpr auto largest = static_cast<RawNumber>(~static_cast<unsigned __int128>(0) >> 1U);
      value = largest;
      break;
    }
  }
  take();
  return is_negative ? -value : value;
}

std::uint64_t Reader::natural(std::string_view what, std::uint64_t maximum) {
  std::uint64_t value = 0;
  if (peek().kind != TokenKind::number || !read_all(peek().text, value) || value > maximum) {
    fail(fmt::format("{}, an integer in 0..{}", what, maximum));
  }
  take();
  return value;
}

std::uint64_t Reader::natural_or(Rule rule, std::string_view what, std::uint64_t maximum) {
  std::uint64_t value = 0;
  const bool larger = peek().kind == TokenKind::number && read_all(peek().text, value) && value > maximum;
  if (!larger) return natural(what, maximum);
  report(rule, fmt::format("{}, an integer in 0..{}", what, maximum));
  take();
  return maximum + 1;
}

std::int64_t Reader::whole(std::string_view what) {
  std::int64_t value = 0;
  double number = 0;
  if (peek().kind != TokenKind::number || read_all(peek().text, value) || !read_all(peek().text, number))
    return integer(what);
  report(Rule::not_whole, fmt::format("{}, an integer", what));
  take();
  constexpr double end = 9223372036854775808.0;
  if (number >= end) return INT64_MAX;
  return number <= -end ? INT64_MIN : std::llround(number);
}

double Reader::limit(std::string_view what) {
  double number = 0;
  std::string_view text = peek().text;
  if (text.starts_with('+')) text.remove_prefix(1);
  if (peek().kind != TokenKind::number ||
      std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc::result_out_of_range)
    return real(what);
  report(Rule::number_too_large, std::string(what));
  take();
  const bool vanishing =
      text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
  const double largest = vanishing ? 0 : std::numeric_limits<double>::max();
  return text.starts_with('-') ? -largest : largest;
}

std::uint64_t Reader::natural_after_minus(std::string_view what) {
  std::uint64_t value = 0;
  const std::string_view text = peek().text;
  if (peek().kind != TokenKind::number || !text.starts_with('-') || !read_all(text.substr(1), value))
    fail(fmt::format("'-' and {}, an integer in 0..{}", what, UINT64_MAX));
  take();
  return value;
}

Message& message_of(Draft& draft, std::uint64_t raw_id, Position at) {
  const auto found = draft.messages_by_id.find(text_id(raw_id));
  if (found == draft.messages_by_id.end()) {
    fail_at(Rule::unknown_message, at,
            fmt::format("no message has the id {}, expected one defined by BO_ above", raw_id));
  }
  return draft.database.messages[found->second];
}

Signal& signal_of(Draft& draft, Message& message, std::string_view name, Position at) {
  const Index& signals = draft.signals[static_cast<std::size_t>(&message - draft.database.messages.data())];
  const auto found = signals.find(name);
  if (found == signals.end()) {
    fail_at(Rule::unknown_signal, at,
            fmt::format("message {} has no signal '{}', expected one of its SG_", message.name, name));
  }
  return message.signals[found->second];
}

Node& node_of(Draft& draft, std::string_view name, Position at) {
  const auto found = draft.nodes.find(name);
  if (found == draft.nodes.end()) {
    fail_at(Rule::undeclared_node, at, undeclared(name));
  }
  return draft.database.nodes[found->second];
}

void check_node(Draft& draft, const std::string& name, Position at) {
  if (!draft.nodes.contains(name)) draft.findings.add_once(Rule::undeclared_node, at, name, undeclared(name));
}

EnvironmentVariable& variable_of(Draft& draft, std::string_view name, Position at) {
  const auto found = draft.variables.find(name);
  if (found == draft.variables.end()) {
    fail_at(Rule::unknown_variable, at,
            fmt::format("no environment variable '{}', expected one defined by EV_ above", name));
  }
  return draft.database.variables[found->second];
}

}  // namespace canhil::dbc
