// Whether a TOML text can be read without running out of stack.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace canhil::scenario {

/// A key may have so many parts, as a.b.c has three. A scenario needs four.
inline constexpr int most_key_parts = 16;
inline constexpr std::string_view deep_key = "a key has more than 16 parts, expected at most that";

/// The line, from 1, of the first key of more parts than that; none if there is none. To be asked before
/// toml++ reads the text: it goes one call deeper for each part.
std::optional<std::size_t> line_of_deep_key(std::string_view text);

}  // namespace canhil::scenario
