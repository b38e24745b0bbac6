// Checks that a TOML text can be parsed without exhausting the stack.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace canhil::scenario {

/// The maximum number of parts of a key. The key a.b.c has three parts. A scenario needs four.
inline constexpr int most_key_parts = 16;
inline constexpr std::string_view deep_key = "a key has more than 16 parts, expected at most that";

/// The line (from 1) of the first key with more than most_key_parts parts; none: there is no such key. This
/// function must be called before toml++ parses the text, because toml++ recurses once for each part.
std::optional<std::size_t> line_of_deep_key(std::string_view text);

}  // namespace canhil::scenario
