// A figure as data, and its drawing. Curves can be told apart without colour: each has its own dashes, its
// own markers, and its name beside its end.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::papers {

struct Curve {
  std::string label{};  ///< short: it stands beside the curve's end
  std::vector<std::pair<double, double>> points{};
  std::vector<std::pair<double, double>> ranges{};  ///< error bars, low and high; as many as points, or none
};

/// Curves over time or something else, values on a logarithmic axis or a linear one.
struct Figure {
  std::string id;  ///< of the HTML element
  std::string title;
  std::string caption;  ///< axes' meaning, settings, run count
  std::string x_label{}, y_label{};
  bool logarithmic = false;  ///< the axis of the values
  std::pair<double, double> x_range{}, y_range{};
  std::vector<double> thresholds{};  ///< horizontal lines, labelled by their value
  std::vector<Curve> curves{};
};

/// Whether any of its curves has error bars.
bool has_ranges(const Figure& figure);

enum class Width { desktop, phone };

/// One SVG element that scales to the width of its container. Error: gnuplot's.
Result<std::string> draw(const Figure& figure, Width width);

}  // namespace canhil::papers
