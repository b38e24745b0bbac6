// Conditions that must hold for every input, and conditions that every error message must meet.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace canhil::fuzz {

inline void expect(bool holds) {
  if (!holds) std::abort();
}

/// Expects a non-empty error message. The message may contain line breaks, because it may quote text of the
/// file that was read.
inline void expect_words(std::string_view message, std::string_view begins_with = "") {
  expect(!message.empty() && message.starts_with(begins_with));
}

/// Expects an error message of one line.
inline void expect_one_line(std::string_view message, std::string_view begins_with = "") {
  expect_words(message, begins_with);
  const bool one_line = std::ranges::none_of(message, [](char c) { return c >= '\0' && c < ' '; });
  if (!one_line) std::fprintf(stderr, "no line: '%.*s'\n", static_cast<int>(message.size()), message.data());
  expect(one_line);
}

}  // namespace canhil::fuzz
