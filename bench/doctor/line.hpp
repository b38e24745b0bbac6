// The findings of `hil-bench doctor`: one line for each examined subject.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace canhil::doctor {

enum class Grade : std::uint8_t { good, weak, bad };

constexpr std::string_view name(Grade grade) {
  constexpr std::array<std::string_view, 3> names{"good", "weak", "bad"};
  return names.at(static_cast<std::size_t>(grade));
}

/// The finding about one subject.
struct Line {
  Grade grade = Grade::good;
  std::string subject;
  std::string found;
  std::string remedy{};  ///< what to do; empty if the grade is good
};

/// The worst grade among the lines; good if there are no lines.
inline Grade worst(const std::vector<Line>& lines) {
  const auto found = std::ranges::max_element(lines, {}, &Line::grade);
  return found == lines.end() ? Grade::good : found->grade;
}

}  // namespace canhil::doctor
