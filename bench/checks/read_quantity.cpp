#include "bench/checks/read_quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/scenario/section.hpp"

namespace canhil::checks {

using quantities::Quantity;

std::string key_of(std::string_view stem, const quantities::Unit& unit) {
  return fmt::format("{}{}", stem, unit.ending);
}

const Quantity* read_quantity(scenario::Section& section, std::span<const Quantity* const> known,
                              const std::function<std::string(const Quantity&)>& refused) {
  constexpr std::string_view key = "quantity";
  std::vector<std::string> words;
  for (const Quantity* one : known) {
    if (refused(*one).empty()) words.emplace_back(one->name);
  }
  if (section.has(key)) {
    const std::string word = section.text(key);
    const auto named = std::ranges::find(known, std::string_view(word), &Quantity::name);
    if (named != known.end()) {
      if (const std::string why = refused(**named); !why.empty())
        section.reject(key, fmt::format("'{}' {}", word, why),
                       fmt::format("one of: {}", fmt::join(words, ", ")));
    }
  }
  const std::string word = section.one_of({key, "A quantity (quantities.md)."}, words);
  const auto found = std::ranges::find(known, std::string_view(word), &Quantity::name);
  return found == known.end() ? known.front() : *found;
}

}  // namespace canhil::checks
