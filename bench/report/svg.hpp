// Pieces of the SVG of all plots.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report/markup.hpp"
#include "bench/report/palette.hpp"
#include "bench/report/plot.hpp"

namespace canhil::report::sketch {

// The size of the drawing in its own units; the width suits the column of a phone.
constexpr double width = 440, height = 230;
constexpr double left = 66, right = 428, top = 24, bottom = 192;

/// Converts values to places.
struct Axis {
  double from = 0, to = 1;        ///< values at the ends
  double at_from = 0, at_to = 1;  ///< places of the ends
  [[nodiscard]] double operator()(double value) const {
    const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return at_from + share * (at_to - at_from);
  }
};

/// The attributes of a line.
inline std::string stroke(std::string_view colour, std::string_view more = "") {
  return fmt::format("fill=\"none\" stroke=\"{}\"{}{}", paint(colour), more.empty() ? "" : " ", more);
}

/// The begin of a drawing. Without a style sheet, it is as wide as there is room, and at most as high as its
/// own units.
inline std::string begin(const std::string& title, std::string_view style) {
  return fmt::format(
      "<svg class=\"{}\" viewBox=\"0 0 {:g} {:g}\" width=\"100%\" height=\"{:g}\" "
      "preserveAspectRatio=\"xMinYMin meet\" role=\"img\" aria-label=\"{}\" font-family=\"sans-serif\" "
      "font-size=\"12\" fill=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">",
      style, width, height, height, escaped(title), paint("soft"));
}

inline std::string text_at(double x, double y, std::string_view anchor, std::string_view label) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(label));
}

inline std::string line(std::string_view attributes, double x1, double y1, double x2, double y2) {
  return fmt::format("<path {} d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", attributes, x1, y1, x2, y2);
}

inline std::string frame() {
  return fmt::format("<path {} d=\"M{} {}V{}H{}\"/>", stroke("soft"), left, top, bottom, right);
}

/// The marks of a horizontal axis: a path and texts.
inline std::string marks_below(const Axis& x) {
  const std::vector<double> columns = round_values(x.from, x.to, 6);
  const std::vector<std::string> labels = mark_labels(columns);
  std::string path, texts;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    path += fmt::format("M{:.1f} {}v5", x(columns[i]), bottom);
    texts += text_at(x(columns[i]), bottom + 19, "middle", labels[i]);
  }
  return fmt::format("<path {} d=\"{}\"/>{}", stroke("soft"), path, texts);
}

/// What the horizontal axis is.
inline std::string name_below(std::string_view name) {
  return text_at((left + right) / 2, bottom + 35, "middle", name);
}

/// The marks of a vertical axis: a path of rules, one of the rule at 0, and texts.
inline std::string marks_beside(const Axis& y) {
  const std::vector<double> rows = round_values(y.from, y.to, 5);
  const std::vector<std::string> labels = mark_labels(rows);
  std::string rules, zero, texts;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    (rows[i] == 0 ? zero : rules) += fmt::format("M{} {:.1f}H{}", left, y(rows[i]), right);
    texts += text_at(left - 6, y(rows[i]) + 4, "end", labels[i]);
  }
  return fmt::format("<path {} d=\"{}\"/><path {} d=\"{}\"/>{}", stroke("rule"), rules, stroke("soft"), zero,
                     texts);
}

}  // namespace canhil::report::sketch
