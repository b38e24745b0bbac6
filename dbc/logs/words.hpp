// The words of a line of text: splitting, numbers, times.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::logs {

inline constexpr std::int64_t ns_per_s = 1'000'000'000;

using Words = std::vector<std::string_view>;

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Compares without regard to case; `lower_word` is in lower case.
constexpr bool same(std::string_view word, std::string_view lower_word) {
  return std::ranges::equal(word, lower_word, {}, lower);
}

/// Splits a text at blanks, tabs and `mark`.
inline void split(std::string_view text, Words& words, char mark = ' ') {
  const auto is_blank = [mark](char c) { return c == ' ' || c == '\t' || c == mark; };
  words.clear();
  for (std::size_t at = 0; at < text.size();) {
    while (at < text.size() && is_blank(text[at])) ++at;
    const std::size_t start = at;
    while (at < text.size() && !is_blank(text[at])) ++at;
    if (at > start) words.push_back(text.substr(start, at - start));
  }
}

/// The number that the whole word is; nullopt: it is none of this type.
template <class Number>
std::optional<Number> number_of(std::string_view word, int base = 10) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The time that a word such as "12.345678" states, in nanoseconds; the separator may be a comma. `unit_ns`
/// is the unit of the word. Nullopt: it is not such a number, or too large.
constexpr std::optional<std::int64_t> time_of(std::string_view word, std::int64_t unit_ns = ns_per_s) {
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() / unit_ns - 1;
  std::int64_t ns = 0;
  std::size_t at = 0;
  const auto is_digit = [&] { return at < word.size() && word[at] >= '0' && word[at] <= '9'; };
  for (; is_digit(); ++at) {
    ns = ns * 10 + (word[at] - '0');
    if (ns > most) return std::nullopt;
  }
  if (at == 0) return std::nullopt;
  ns *= unit_ns;
  if (at == word.size()) return ns;
  if (word[at] != '.' && word[at] != ',') return std::nullopt;
  ++at;
  for (std::int64_t digit_ns = unit_ns / 10; is_digit(); ++at, digit_ns /= 10)
    ns += (word[at] - '0') * digit_ns;
  return at == word.size() ? std::optional(ns) : std::nullopt;
}

/// The name of an interface as one word of printable ASCII characters, which every format can store: each
/// other character becomes '_'.
inline std::string interface_name(std::string_view name) {
  std::string word(name);
  std::ranges::replace_if(
      word, [](char c) { return c <= ' ' || c > '~'; }, '_');
  return word;
}

}  // namespace canhil::logs
