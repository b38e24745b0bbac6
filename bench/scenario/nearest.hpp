// Which name was meant by a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace canhil::scenario {

/// The name that lacks only its unit or other ending (tilt_deg of tilt), else the one that takes the fewest
/// edits (insert, delete, replace a letter) from `word`, if they are at most a third of its letters or two;
/// else empty.
std::string nearest(std::string_view word, std::span<const std::string> names);

/// What to say was expected instead of `word`: the nearest name, or all of them.
std::string expected_instead(std::string_view word, std::span<const std::string> names);

}  // namespace canhil::scenario
