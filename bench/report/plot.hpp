// Plots as SVG. Dashes and shapes distinguish the lines without colour. What carries meaning is in
// attributes, so a plot needs no style sheet; page.js makes a LinePlot interactive.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace canhil::report {

/// A distribution of times on two logarithmic axes, so that a single late answer among a million is visible.
struct HistogramPlot {
  struct Bar {
    double from_us = 0, to_us = 0;
    double count = 0;
  };
  struct Mark {
    std::string label;
    double at_us = 0;
  };
  std::string title;      ///< alternative text of the picture
  std::vector<Bar> bars;  ///< finer than in the picture, which combines bars
  std::vector<Mark> marks;
};
/// An <svg> element; a line of text if there is nothing to show.
std::string svg(const HistogramPlot& plot);

/// The range of some values; values that are not finite are ignored.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// A quantity over time: its range in each stretch of time, between dashed limits. Or several named curves.
/// The values are the coordinates of the curves in the SVG, with seven digits, so that page.js can read them.
struct LinePlot {
  /// A check's limit for the absolute value, in a part of the time.
  struct Bar {
    double below = 0;
    double from_s = 0, to_s = 0;
    std::string name{};  ///< in the legend
  };
  /// A ring around the largest value.
  struct Ring {
    double t_s = 0;
    std::string name{};  ///< in the legend
  };
  /// Times that are shaded over the whole height.
  struct Band {
    std::vector<std::pair<double, double>> times_s;
    std::string name{};  ///< in the legend
  };
  /// A further curve, with one value for each time; not finite: a gap.
  struct Line {
    std::string name;
    std::vector<double> values;
  };
  std::string title;
  std::string unit;
  std::vector<double> t_s;
  std::vector<double> low, high;  ///< range of the quantity, one for each time; not finite: a gap
  std::vector<double> limit{};    ///< dashed lines at +-limit; one for each time, or none; not finite: a gap
  std::vector<double> truth{};    ///< dotted line; one value for each time, or none; not finite: a gap
  std::vector<double> levels{};   ///< dashed horizontal lines
  std::vector<Bar> bars{};        ///< heavy lines with dots at both ends
  std::vector<Ring> worst{};
  std::vector<Band> bands{};
  std::vector<Line> lines{};     ///< each with its own dashes and colour
  bool from_zero = false;        ///< the axis begins at 0: for a quantity without sign
  bool begins_at_first = false;  ///< the time axis begins at the first time instead of 0
  std::string name{};            ///< of the quantity in the legend; empty: `title`
  std::string limit_name{}, truth_name{}, levels_name{};
  std::string t_unit = "s";  ///< of the horizontal axis
};
/// An <svg> element and the legend; a line of text if there is nothing to show.
std::string drawn(const LinePlot& plot);

/// When flags were set: a row for each, with a bar for each stretch of time.
struct FlagPlot {
  struct Row {
    std::string label;
    std::vector<std::pair<double, double>>
        set_s;  ///< from the first answer in which it is set to the next without
  };
  std::string title;
  std::vector<Row> rows;
  double end_s = 0;
};
std::string svg(const FlagPlot& plot);

/// The range of the picture. It includes `limit` and `bars` unless they are so large that they would hide the
/// quantity, as the sigma of the first instants may be.
Extent extent_of(const LinePlot& plot);
/// Whether a check's limit lies within the picture.
bool shows(const LinePlot& plot, const LinePlot::Bar& bar);

/// The labels of an axis's marks, with as many digits as needed to distinguish them.
std::vector<std::string> mark_labels(const std::vector<double>& values);

/// At most `most` round values within a range, for the marks of an axis: steps of 1, 2 or 5 times a power of
/// ten.
std::vector<double> round_values(double from, double to, int most);

}  // namespace canhil::report
