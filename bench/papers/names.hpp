// The papers that hil-bench-paper reproduces.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace canhil::papers {

inline constexpr std::array<std::string_view, 4> paper_names{"transfer", "inflight", "los", "wind"};

/// The names as a list for error messages: "transfer or inflight or los or wind".
inline std::string names() {
  std::string text;
  for (const std::string_view name : paper_names) text += (text.empty() ? "" : " or ") + std::string(name);
  return text;
}

}  // namespace canhil::papers
