// Plots as SVG: drawn with the page's style classes, told apart by dash and shape, not by colour alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace canhil::report {

/// What a distribution of times looks like, both axes logarithmic: a single late answer among a million is
/// seen.
struct HistogramPlot {
  struct Bar {
    double from_us = 0, to_us = 0;
    double count = 0;
  };
  struct Mark {
    std::string label;
    double at_us = 0;
  };
  std::string title;      ///< read out in place of the picture
  std::vector<Bar> bars;  ///< finer than the picture: they are put together
  std::vector<Mark> marks;
};
/// An <svg> element; a line of text if there is nothing to show.
std::string svg(const HistogramPlot& plot);

/// The range of some values; those that are not finite count for nothing.
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

/// A quantity over time: the range that it covers in each stretch of it, between dashed limits.
struct LinePlot {
  /// What the absolute value is to stay below, in a part of the time.
  struct Bar {
    double below = 0;
    double from_s = 0, to_s = 0;
  };
  std::string title;
  std::string unit;
  std::vector<double> t_s;
  std::vector<double> low, high;  ///< of the quantity, as many as times; not finite: a gap
  std::vector<double> limit{};    ///< dashed at plus and minus this; as many, or none; not finite: a gap
  std::vector<double> truth{};    ///< a dotted line; as many, or none; not finite: a gap
  std::vector<double> levels{};   ///< dashed horizontal lines
  std::vector<Bar> bars{};        ///< heavy lines with an end at either side
  bool from_zero = false;         ///< the axis begins at 0: a quantity without a sign
  bool begins_at_first = false;   ///< the time axis begins at the first time, in place of 0
};
std::string svg(const LinePlot& plot);

/// The values that the picture has room for. Limits and bars count as far as they do not hide what lies
/// within them: the sigma of the first instants is large.
Extent extent_of(const LinePlot& plot);
/// Whether a bar lies within the picture.
bool shows(const LinePlot& plot, const LinePlot::Bar& bar);

/// The marks of an axis in words, with as many digits as tell one from the next.
std::vector<std::string> mark_labels(const std::vector<double>& values);

/// Round values within a range, at most `most`, for the marks of an axis: steps of 1, 2 or 5 times a power of
/// ten.
std::vector<double> round_values(double from, double to, int most);

}  // namespace canhil::report
