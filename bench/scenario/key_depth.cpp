#include "bench/scenario/key_depth.hpp"

#include <cstddef>

namespace canhil::scenario {
namespace {

// The delimiter at the start of a quoted text: " or ', or three of either. The same delimiter ends the text.
// A text in triple quotes may span lines.
std::string_view quote_at(std::string_view text) {
  if (text.starts_with("\"\"\"") || text.starts_with("'''")) return text.substr(0, 3);
  return text.substr(0, 1);
}

// The position after the quoted text that begins here; an unterminated text ends with its line or with the
// file.
std::size_t behind_quoted(std::string_view text) {
  const std::string_view quote = quote_at(text);
  for (std::size_t i = quote.size(); i < text.size(); ++i) {
    if (quote[0] == '"' && text[i] == '\\')
      ++i;
    else if (text.substr(i).starts_with(quote))
      return i + quote.size();
    else if (quote.size() == 1 && text[i] == '\n')
      return i;
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_of_deep_key(std::string_view text) {
  std::size_t line = 1;
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {  // a quoted part of a key, or a quoted value
      const std::size_t length = behind_quoted(text.substr(i));
      for (const char skipped : text.substr(i, length)) line += skipped == '\n' ? 1 : 0;
      i += length;
      continue;
    }
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
      continue;
    }
    // The dots of a key have only key parts and blanks between them; a number has at most one dot.
    if (c == '.')
      ++dots;
    else if (c == '=' || c == ',' || c == '\n' || c == '[' || c == ']' || c == '{' || c == '}')
      dots = 0;
    if (dots >= most_key_parts) return line;
    if (c == '\n') ++line;
    ++i;
  }
  return std::nullopt;
}

}  // namespace canhil::scenario
