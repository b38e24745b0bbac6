// The colours of all pages. They stand in the attributes of elements, so that a page keeps its meaning where
// a server forbids its style sheet; the style sheet has the same colours as variables, and others for the
// dark.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace canhil::report {

struct Colour {
  std::string_view name, light;
};
inline constexpr std::array palette{Colour{"paper", "#fff"},   Colour{"ink", "#1b1b1b"},
                                    Colour{"soft", "#5a5a5a"}, Colour{"rule", "#d8d8d8"},
                                    Colour{"line", "#0b5394"}, Colour{"fill", "#9fc0e4"},
                                    Colour{"warn", "#b03000"}, Colour{"yes", "#00603e"},
                                    Colour{"no", "#a32a00"},   Colour{"unknown", "#6b5000"}};

/// A colour of the palette on light paper; empty: the palette has none of this name.
constexpr std::string_view light(std::string_view name) {
  for (const Colour& one : palette) {
    if (one.name == name) return one.light;
  }
  return {};
}

/// A colour as an attribute of SVG: the variable of the style sheet or, without one, the colour on light
/// paper.
inline std::string paint(std::string_view name) {
  return std::string("var(--").append(name).append(",").append(light(name)).append(")");
}

}  // namespace canhil::report
