#include "dbc/parser/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

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

template <class Number>
bool read_all(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

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

}  // namespace

bool is_keyword(std::string_view word) { return std::ranges::find(keywords, word) != keywords.end(); }

void Reader::fail(const std::string& expected) const {
  throw ParseFailure{peek().at, fmt::format("unexpected {}, expected {}", shown(peek()), expected)};
}

bool Reader::take_mark_if(char mark) {
  if (!at_mark(mark)) return false;
  take();
  return true;
}

void Reader::mark(char mark) {
  if (!take_mark_if(mark)) fail(fmt::format("'{}'", mark));
}

std::string Reader::word(std::string_view what) {
  if (peek().kind != TokenKind::word || is_keyword(peek().text)) fail(std::string(what));
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

std::uint64_t Reader::natural(std::string_view what, std::uint64_t maximum) {
  std::uint64_t value = 0;
  if (peek().kind != TokenKind::number || !read_all(peek().text, value) || value > maximum) {
    fail(fmt::format("{}, an integer in 0..{}", what, maximum));
  }
  take();
  return value;
}

Message& message_of(Draft& draft, std::uint64_t raw_id, Position at) {
  const bool extended = (raw_id & extended_flag) != 0;
  const auto id = raw_id == independent_signals_id
                      ? independent_signals_id
                      : static_cast<std::uint32_t>(raw_id & ~std::uint64_t{extended_flag});
  auto& messages = draft.database.messages;
  const auto found =
      std::ranges::find_if(messages, [&](const Message& m) { return m.id == id && m.extended == extended; });
  if (found == messages.end()) {
    throw ParseFailure{at,
                       fmt::format("no message has the id {}, expected one defined by BO_ above", raw_id)};
  }
  return *found;
}

Signal& signal_of(Message& message, std::string_view name, Position at) {
  const auto found = std::ranges::find(message.signals, name, &Signal::name);
  if (found == message.signals.end()) {
    throw ParseFailure{
        at, fmt::format("message {} has no signal '{}', expected one of its SG_", message.name, name)};
  }
  return *found;
}

Node& node_of(Draft& draft, std::string_view name, Position at) {
  const auto found = std::ranges::find(draft.database.nodes, name, &Node::name);
  if (found == draft.database.nodes.end()) {
    throw ParseFailure{at, fmt::format("no node '{}', expected one listed in BU_", name)};
  }
  return *found;
}

EnvironmentVariable& variable_of(Draft& draft, std::string_view name, Position at) {
  const auto found = std::ranges::find(draft.database.variables, name, &EnvironmentVariable::name);
  if (found == draft.database.variables.end()) {
    throw ParseFailure{at,
                       fmt::format("no environment variable '{}', expected one defined by EV_ above", name)};
  }
  return *found;
}

}  // namespace canhil::dbc
