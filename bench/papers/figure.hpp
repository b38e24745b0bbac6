// A figure as data, and its drawing. Curves are distinguishable without colour: each has its own dashes and
// markers, and its name at its end.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::papers {

struct Curve {
  std::string label{};  ///< short: shown at the curve's end
  std::vector<std::pair<double, double>> points{};
  std::vector<std::pair<double, double>> ranges{};  ///< error bars, low and high; as many as points, or none
};

/// Curves over time or another quantity, with a logarithmic or linear axis of values.
struct Figure {
  std::string id;  ///< id of the HTML element
  std::string title;
  std::string caption;  ///< meaning of the axes, settings, number of runs
  std::string x_label{}, y_label{};
  bool logarithmic = false;  ///< whether the axis of values is logarithmic
  std::pair<double, double> x_range{}, y_range{};
  std::vector<double> thresholds{};  ///< horizontal lines, labelled by their value
  std::vector<Curve> curves{};
};

/// Whether any curve has error bars.
bool has_ranges(const Figure& figure);

enum class Width { desktop, phone };

/// Draws a figure as one SVG element that scales to the width of its container. Error: the error that gnuplot
/// reports.
Result<std::string> draw(const Figure& figure, Width width);

}  // namespace canhil::papers
