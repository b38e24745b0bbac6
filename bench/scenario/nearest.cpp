#include "bench/scenario/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace canhil::scenario {
namespace {

/// Levenshtein distance, row by row.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// Whether another word follows `word`: _deg, .pitch, Update.
bool begins_with_words(std::string_view name, std::string_view word) {
  if (word.empty() || name.size() <= word.size() || !name.starts_with(word)) return false;
  const char next = name[word.size()];
  return next == '_' || next == '.' || (next >= 'A' && next <= 'Z');
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t longest = 100;  // longest word that is compared
  if (word.size() > longest) return {};
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : names) {
    if (begins_with_words(name, word)) return name;
    const std::size_t distance = edits(word, name);
    if (distance >= fewest) continue;
    fewest = distance;
    best = name;
  }
  return best;
}

std::string expected_instead(std::string_view word, std::span<const std::string> names) {
  const std::string meant = nearest(word, names);
  if (!meant.empty()) return fmt::format("'{}'", meant);
  if (names.empty()) return "none";
  return fmt::format("one of: {}", fmt::join(names, ", "));
}

}  // namespace canhil::scenario
