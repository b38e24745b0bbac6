// Delta debugging: finds a smallest input that still has a given property.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace canhil::campaign::matrix {

/// A minimal subset of the items that still has the property: if any single item is removed, the property is
/// lost. All `items` together must have the property. Algorithm ddmin of Zeller and Hildebrandt, Simplifying
/// and Isolating Failure-Inducing Input, IEEE TSE 28(2), 2002.
template <class Item>
std::vector<Item> least_of(std::vector<Item> items,
                           const std::function<bool(const std::vector<Item>&)>& shows) {
  using Place = std::ptrdiff_t;
  std::size_t parts = 2;
  while (items.size() >= 2) {
    parts = std::min(parts, items.size());
    bool smaller = false;
    for (std::size_t part = 0; part < parts && !smaller; ++part) {
      const auto begin = static_cast<Place>(part * items.size() / parts);
      const auto end = static_cast<Place>((part + 1) * items.size() / parts);
      std::vector<Item> subset(items.begin() + begin, items.begin() + end);
      std::vector<Item> complement(items.begin(), items.begin() + begin);
      complement.insert(complement.end(), items.begin() + end, items.end());
      if (shows(subset)) {
        items = std::move(subset);
        parts = 2;
        smaller = true;
      } else if (parts > 2 && shows(complement)) {  // with two parts, the complement of one is the other
        items = std::move(complement);
        parts = std::max<std::size_t>(parts - 1, 2);
        smaller = true;
      }
    }
    if (smaller) continue;
    if (parts >= items.size()) break;
    parts *= 2;
  }
  return items;
}

/// A part of [from, to] that still has the property and cannot be shortened by a step at either end. The
/// search bisects in whole steps; it shortens the part at its end if possible, otherwise at its beginning.
/// The whole of [from, to] must have the property.
inline std::pair<std::int64_t, std::int64_t> least_stretch(
    std::int64_t from, std::int64_t to, std::int64_t step,
    const std::function<bool(std::int64_t from, std::int64_t to)>& shows) {
  const auto half = [step](std::int64_t length) { return length / 2 / step * step; };
  for (std::int64_t cut = std::max(half(to - from), step); cut > 0 && to - from >= step;) {
    cut = std::min(cut, to - from);
    if (shows(from, to - cut)) {
      to -= cut;
    } else if (shows(from + cut, to)) {
      from += cut;
    } else {
      cut = cut > step ? std::max(half(cut), step) : 0;
    }
  }
  return {from, to};
}

}  // namespace canhil::campaign::matrix
