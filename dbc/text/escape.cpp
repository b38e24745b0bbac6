#include "dbc/text/escape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace canhil {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = true;  // false: the byte is not part of a UTF-8 character
};

// The first character of a text that is not empty. UTF-8 (RFC 3629): no surrogates, no overlong forms.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {.code = lead};
  const Character invalid{.code = lead, .valid = false};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return invalid;
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  std::uint32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return invalid;
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[bytes] || code > 0x10FFFF || surrogate) return invalid;
  return {.code = code, .bytes = bytes};
}

struct Range {
  std::uint32_t first, last;
};
constexpr std::array<Range, 10> not_shown{{{0x00, 0x1F},
                                           {0x7F, 0x9F},
                                           {0x061C, 0x061C},
                                           {0x200B, 0x200F},
                                           {0x2028, 0x202E},
                                           {0x2060, 0x206F},
                                           {0xFDD0, 0xFDEF},
                                           {0xFEFF, 0xFEFF},
                                           {0xFFF9, 0xFFFB},
                                           {0xE0000, 0xE007F}}};

bool is_shown(std::uint32_t code) {
  if ((code & 0xFFFEU) == 0xFFFE) return false;  // the last two of each plane are noncharacters
  return std::ranges::none_of(not_shown,
                              [&](const Range& range) { return code >= range.first && code <= range.last; });
}

std::string visible(const Character& character) {
  if (!character.valid || character.code < 0x80) return fmt::format("\\x{:02x}", character.code);
  if (character.code < 0x10000) return fmt::format("\\u{:04x}", character.code);
  return fmt::format("\\U{:08x}", character.code);
}

// `replace` returns the text for an ASCII character of the medium; null: as in every medium.
template <class Replace>
std::string escape(std::string_view text, const Replace& replace) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_of(text);
    const std::string_view own = text.substr(0, character.bytes);
    const char* replaced = character.code < 0x80 ? replace(own.front()) : nullptr;
    if (replaced != nullptr)
      safe += replaced;
    else if (character.valid && is_shown(character.code))
      safe += own;
    else
      safe += visible(character);
    text.remove_prefix(own.size());
  }
  return safe;
}

}  // namespace

std::string for_terminal(std::string_view text) {
  return escape(text, [](char c) { return c == '\n' ? "\n" : c == '\t' ? "\t" : nullptr; });
}

std::string one_line(std::string_view field) {
  return escape(field, [](char c) -> const char* {
    return c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '\r' ? "\\r" : nullptr;
  });
}

std::string for_markup(std::string_view text) {
  return escape(text, [](char c) -> const char* {
    switch (c) {
      case '&':
        return "&amp;";
      case '<':
        return "&lt;";
      case '>':
        return "&gt;";
      case '"':
        return "&quot;";
      case '\n':
      case '\r':
      case '\t':
        return " ";
      default:
        return nullptr;
    }
  });
}

std::string for_csv(std::string_view cell) {
  std::string plain = one_line(cell);
  if (plain.starts_with('=') || plain.starts_with('+') || plain.starts_with('-') || plain.starts_with('@'))
    plain.insert(plain.begin(), '\'');
  if (plain.find_first_of(",\"") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace canhil
