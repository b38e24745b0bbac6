// Maps words in a scenario to the values of an enumeration.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {

/// The value that the key names; `names` are in the order of the enumeration. It is an error if the word is
/// unknown, or if the key is missing and there is no fallback.
template <class Enum>
Enum read_enum(Section& section, const Key& key, std::span<const std::string_view> names,
               std::optional<Enum> fallback = {}) {
  const std::vector<std::string> words(names.begin(), names.end());
  std::optional<std::string> usual;
  if (fallback) usual = words[static_cast<std::size_t>(*fallback)];
  const auto found = std::ranges::find(words, section.one_of(key, words, usual));
  return found == words.end() ? Enum{} : static_cast<Enum>(found - words.begin());
}

}  // namespace canhil::scenario
