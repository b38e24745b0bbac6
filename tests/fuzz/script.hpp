// Interprets the input of a fuzzer as a list of actions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace canhil::fuzz {

/// Reads the input byte by byte; returns zeros after its end.
class Script {
 public:
  explicit Script(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  [[nodiscard]] bool over() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  /// Takes `count` bytes, or all that are left if fewer.
  std::span<const std::uint8_t> bytes(std::size_t count) {
    const auto taken = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  /// Copies the next bytes of the input to `to`. If too few are left, the rest of `to` keeps its values.
  void fill(std::span<std::uint8_t> to) { std::ranges::copy(bytes(to.size()), to.begin()); }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace canhil::fuzz
