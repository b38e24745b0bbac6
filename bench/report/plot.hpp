// Plots as SVG: drawn with the page's style classes, told apart by dash and shape, not by colour alone.
#pragma once

#include <cstdint>
#include <optional>
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

/// A quantity over time: the range that it covers in each stretch of it, between dashed limits.
struct LinePlot {
  std::string title;
  std::string unit;
  std::vector<double> t_s;
  std::vector<double> low, high;  ///< of the quantity, as many as times; not finite: a gap
  std::vector<double> limit;      ///< dashed at plus and minus this; as many, or none; not finite: a gap
  std::vector<double> levels;     ///< dashed horizontal lines
  bool from_zero = false;         ///< the axis begins at 0: a quantity without a sign
};
std::string svg(const LinePlot& plot);

/// Round values within a range, at most `most`, for the marks of an axis: steps of 1, 2 or 5 times a power of
/// ten.
std::vector<double> round_values(double from, double to, int most);

}  // namespace canhil::report
