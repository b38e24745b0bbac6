// Suggests the intended name for a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace canhil::scenario {

/// Finds the name that the user probably meant by `word`. This is the name that equals `word` except for a
/// unit or another word at its end (tilt for tilt_deg, Wind for WindUpdate). If there is none, it is the name
/// that needs the fewest edits (insert, delete or replace a letter), if the number of edits is at most two or
/// at most a third of the number of letters of `word`. Otherwise the result is empty.
std::string nearest(std::string_view word, std::span<const std::string> names);

/// What was expected instead of `word`: the nearest name, or all names.
std::string expected_instead(std::string_view word, std::span<const std::string> names);

}  // namespace canhil::scenario
