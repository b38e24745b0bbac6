#include "bench/nodes/clipped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace canhil::nodes {

double Clipped::Signal::beyond(double one) const {
  return std::isnan(one) ? HUGE_VAL : std::max(lowest - one, one - highest);
}

void Clipped::Signal::take(double one) {
  if (count == 0 || beyond(one) > beyond(value)) value = one;
}

void Clipped::add(std::string_view message, std::string_view signal, double value, const Range& range) {
  Signal& one = signals_[fmt::format("{}.{}", message, signal)];
  if (one.count == 0)
    one = {.lowest = range.lowest, .highest = range.highest, .unit = std::string(range.unit)};
  one.take(value);
  ++one.count;
}

void Clipped::add(const Clipped& others) {
  for (const auto& [name, other] : others.signals_) {
    const auto [own, first] = signals_.try_emplace(name, other);
    if (first) continue;
    own->second.take(other.value);
    own->second.count += other.count;
  }
}

std::vector<std::string> Clipped::to_text() const {
  std::vector<std::string> lines;
  for (const auto& [name, one] : signals_)
    lines.push_back(fmt::format("{} holds {:g} to {:g} {}, its node measures {:g} ({} times beyond)", name,
                                one.lowest, one.highest, one.unit, one.value, one.count));
  return lines;
}

}  // namespace canhil::nodes
