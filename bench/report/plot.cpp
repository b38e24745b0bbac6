#include "bench/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/markup.hpp"

namespace canhil::report {
namespace {

// The size of the drawing in its own units; the width suits the column of a phone.
constexpr double width = 440, height = 230;
constexpr double left = 66, right = 428, top = 24, bottom = 192;

struct Axis {
  double from = 0, to = 1;        // values at the ends
  double at_from = 0, at_to = 1;  // positions of the ends
  [[nodiscard]] double operator()(double value) const {
    const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return at_from + share * (at_to - at_from);
  }
};

std::string begin(const std::string& title) {
  return fmt::format(
      "<svg viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\" xmlns=\"http://www.w3.org/2000/svg\">",
      width, height, escaped(title));
}

std::string text_at(double x, double y, std::string_view anchor, std::string_view label) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     escaped(label));
}

std::string line(std::string_view style, double x1, double y1, double x2, double y2) {
  return fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", style, x1, y1, x2, y2);
}

std::string frame() {
  return fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>", left, top, bottom, right);
}

std::string time_of(double us) {
  if (us < 1000) return fmt::format("{:g} us", us);
  if (us < 1e6) return fmt::format("{:g} ms", us / 1e3);
  return fmt::format("{:g} s", us / 1e6);
}

// Returns 1, 10, 100 ...; if the range is less than about two decades, also 2 and 5 times these values.
std::vector<double> decades(double from_log, double to_log) {
  std::vector<double> values;
  const bool fine = to_log - from_log < 2.2;
  for (double decade = std::floor(from_log); decade <= to_log; ++decade) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = step * std::pow(10, decade);
      const double at = std::log10(value);
      if ((fine || step == 1) && at >= from_log - 1e-9 && at <= to_log + 1e-9) values.push_back(value);
    }
  }
  return values;
}

// Combines counts into bars of equal width.
std::vector<double> columns(const HistogramPlot& plot, const Axis& x, std::size_t count) {
  std::vector<double> sums(count, 0);
  for (const HistogramPlot::Bar& bar : plot.bars) {
    const double middle_us = std::max((bar.from_us + bar.to_us) / 2, 0.5);
    const double share = (x(std::log10(middle_us)) - x.at_from) / (x.at_to - x.at_from);
    sums[std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)))] += bar.count;
  }
  return sums;
}

// A contiguous sequence of finite points.
struct Stretch {
  std::size_t from, to;
};
template <class There>
std::vector<Stretch> stretches(std::size_t size, There there) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i < size; ++i) {
    if (!there(i)) continue;
    if (found.empty() || found.back().to != i) found.push_back({i, i});
    found.back().to = i + 1;
  }
  return found;
}

// The labels of the time axis, in s.
std::string time_marks(const Axis& x) {
  std::string out;
  const std::vector<double> columns = round_values(x.from, x.to, 6);
  const std::vector<std::string> labels = mark_labels(columns);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    out += line("tick", x(columns[i]), bottom, x(columns[i]), bottom + 5);
    out += text_at(x(columns[i]), bottom + 19, "middle", labels[i]);
  }
  return out + text_at((left + right) / 2, bottom + 35, "middle", "s");
}

constexpr double limit_room = 2.5;  // limits up to this multiple of the largest value are shown
constexpr double bar_room = 6;      // the same factor for the limits of checks, which matter most

std::string path_along(const LinePlot& plot, const std::vector<double>& values, double sign, const Axis& x,
                       const Axis& y) {
  std::string path;
  const auto shown = [&](std::size_t i) {
    return std::isfinite(values[i]) && sign * values[i] >= y.from && sign * values[i] <= y.to;
  };
  for (const Stretch& stretch : stretches(values.size(), shown)) {
    for (std::size_t i = stretch.from; i < stretch.to; ++i)
      path +=
          fmt::format("{}{:.1f} {:.1f}", i == stretch.from ? 'M' : 'L', x(plot.t_s[i]), y(sign * values[i]));
  }
  return path;
}

std::string bar_line(const LinePlot::Bar& bar, double value, const Axis& x, const Axis& y) {
  constexpr double end = 4;  // length of the end mark
  const double from = x(bar.from_s), to = x(bar.to_s), at = y(value);
  return fmt::format(
      "<path class=\"bar\" d=\"M{0:.1f} {1:.1f}V{2:.1f}M{0:.1f} {3:.1f}H{4:.1f}M{4:.1f} {1:.1f}V{2:.1f}\"/>",
      from, at - end, at + end, at, to);
}

// The area between low and high, with its edge drawn, so that a thin area is visible as a line.
std::string area(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string path;
  const auto there = [&](std::size_t i) { return std::isfinite(plot.low[i]) && std::isfinite(plot.high[i]); };
  for (const Stretch& stretch : stretches(plot.t_s.size(), there)) {
    for (std::size_t i = stretch.from; i < stretch.to; ++i)
      path += fmt::format("{}{:.1f} {:.1f}", i == stretch.from ? 'M' : 'L', x(plot.t_s[i]), y(plot.high[i]));
    for (std::size_t i = stretch.to; i-- > stretch.from;)
      path += fmt::format("L{:.1f} {:.1f}", x(plot.t_s[i]), y(plot.low[i]));
    path += 'Z';
  }
  return fmt::format("<path class=\"area\" d=\"{}\"/>", path);
}

}  // namespace

Extent extent_of(const LinePlot& plot) {
  Extent own;
  for (const std::vector<double>* values : {&plot.low, &plot.high, &plot.truth})
    for (const double value : *values) own.add(value);
  if (plot.from_zero) own.add(0);
  Extent all = own;
  for (const double level : plot.levels) all.add(level);
  const double large = std::max(std::abs(own.low), std::abs(own.high));
  double most = -1;
  for (const double limit : plot.limit) most = std::isfinite(limit) ? std::max(most, limit) : most;
  most = std::min(most, limit_room * large);
  for (const LinePlot::Bar& bar : plot.bars) {
    if (bar.below <= bar_room * large) most = std::max(most, bar.below);
  }
  if (most >= 0) {
    all.add(most);
    if (!plot.from_zero) all.add(-most);
  }
  if (all.size() < 1e-12 * std::max(1.0, std::abs(all.high))) {
    all.add(all.high + 1);
    all.add(all.low - 1);
  }
  return all;
}

bool shows(const LinePlot& plot, const LinePlot::Bar& bar) { return bar.below <= extent_of(plot).high; }

std::vector<std::string> mark_labels(const std::vector<double>& values) {
  std::vector<std::string> labels;
  const double step = values.size() > 1 ? values[1] - values[0] : values.empty() ? 1.0 : std::abs(values[0]);
  const double largest = values.empty() ? 0 : std::max(std::abs(values.front()), std::abs(values.back()));
  if (!(step > 0)) return std::vector<std::string>(values.size(), "0");
  // Outside this range plain digits need too much room.
  const bool plain = largest < 1e6 && largest >= 1e-4;
  const double lowest = std::floor(std::log10(step) + 1e-9);
  const double highest = std::floor(std::log10(std::max(largest, step)) + 1e-9);
  const int digits = static_cast<int>(std::max(0.0, plain ? -lowest : highest - lowest));
  for (const double value : values)
    labels.push_back(value == 0 ? "0"
                     : plain    ? fmt::format("{:.{}f}", value, digits)
                                : fmt::format("{:.{}e}", value, digits));
  return labels;
}

std::vector<double> round_values(double from, double to, int most) {
  if (!(to > from)) return {from};
  const double rough = (to - from) / most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double times : {5.0, 2.0, 1.0}) {
    if (times * power >= rough) step = times * power;
  }
  std::vector<double> values;
  for (double i = std::ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
    values.push_back(i == 0 ? 0.0 : i * step);  // avoids -0
  return values;
}

std::string svg(const HistogramPlot& plot) {
  if (plot.bars.empty()) return "<p class=\"note\">nothing measured</p>";
  constexpr std::size_t column_count = 92;
  Extent extent;
  for (const HistogramPlot::Bar& bar : plot.bars) {
    extent.add(std::log10(std::max(bar.from_us, 1.0)));
    extent.add(std::log10(std::max(bar.to_us, 2.0)));
  }
  if (extent.high - extent.low < 0.3) {
    extent.low -= 0.15;
    extent.high += 0.15;
  }
  const Axis x{extent.low, extent.high, left, right};
  const std::vector<double> counts = columns(plot, x, column_count);
  const double most = std::ranges::max(counts);
  // The axis begins at 0.5, so that a single answer is a visible bar.
  const Axis y{std::log10(0.5), std::log10(most) + 0.12, bottom, top};
  std::string out = begin(plot.title);
  for (const double value : decades(0, y.to)) {
    out += line("rule", left, y(std::log10(value)), right, y(std::log10(value)));
    out += text_at(left - 6, y(std::log10(value)) + 4, "end", fmt::format("{:g}", value));
  }
  double last_label = -100;
  for (const double value : decades(x.from, x.to)) {
    const double at = x(std::log10(value));
    out += line("tick", at, bottom, at, bottom + 5);
    if (at - last_label < 46) continue;
    out += text_at(std::min(at, right - 10), bottom + 19, "middle", time_of(value));
    last_label = at;
  }
  const double step = (right - left) / static_cast<double>(column_count);
  std::string bars;
  for (std::size_t i = 0; i < column_count; ++i) {
    if (counts[i] <= 0) continue;
    bars += fmt::format("M{:.1f} {}V{:.1f}h{:.1f}V{}Z", left + step * static_cast<double>(i), bottom,
                        y(std::log10(counts[i])), step * 0.86, bottom);
  }
  out += fmt::format("<path class=\"bars\" d=\"{}\"/>", bars);
  double last_mark = -100;
  for (const HistogramPlot::Mark& mark : plot.marks) {
    const double at = x(std::log10(std::max(mark.at_us, 1.0)));
    out += line("mark", at, top - 4, at, bottom);
    if (at - last_mark <= 30) continue;
    out += text_at(std::min(at, right - 8), top - 9, "middle", mark.label);
    last_mark = at;
  }
  out += frame();
  out += text_at((left + right) / 2, bottom + 35, "middle",
                 "time (logarithmic); height: how many (logarithmic)");
  return out + "</svg>";
}

std::string svg(const LinePlot& plot) {
  const Extent extent = extent_of(plot);
  if (plot.t_s.empty() || !std::isfinite(extent.low)) return "<p class=\"note\">nothing to show</p>";
  const double begins = plot.begins_at_first ? plot.t_s.front() : std::min(plot.t_s.front(), 0.0);
  const Axis x{begins, std::max(plot.t_s.back(), plot.t_s.front() + 1e-3), left, right};
  const double margin = 0.05 * extent.size();
  const Axis y{plot.from_zero ? 0.0 : extent.low - margin, extent.high + margin, bottom, top};
  std::string out = begin(plot.title);
  const std::vector<double> rows = round_values(y.from, y.to, 5);
  const std::vector<std::string> row_labels = mark_labels(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += line(rows[i] == 0 ? "zero" : "rule", left, y(rows[i]), right, y(rows[i]));
    out += text_at(left - 6, y(rows[i]) + 4, "end", row_labels[i]);
  }
  out += time_marks(x);
  out += area(plot, x, y);
  if (plot.limit.size() == plot.t_s.size()) {
    for (const double sign : {1.0, -1.0})
      out += fmt::format("<path class=\"limit\" d=\"{}\"/>", path_along(plot, plot.limit, sign, x, y));
  }
  if (plot.truth.size() == plot.t_s.size())
    out += fmt::format("<path class=\"truth\" d=\"{}\"/>", path_along(plot, plot.truth, 1, x, y));
  for (const double level : plot.levels) out += line("limit", left, y(level), right, y(level));
  for (const LinePlot::Bar& bar : plot.bars) {
    if (!shows(plot, bar)) continue;
    out += bar_line(bar, bar.below, x, y);
    if (y.from <= -bar.below) out += bar_line(bar, -bar.below, x, y);
  }
  for (const double t_s : plot.worst_s) {
    const auto later = std::ranges::lower_bound(plot.t_s, t_s);
    if (later == plot.t_s.end()) continue;
    // A point of the plot may join several values: the worst one is in the point at or before its time.
    auto index = static_cast<std::size_t>(later - plot.t_s.begin());
    if (*later > t_s && index > 0) --index;
    const double value =
        std::abs(plot.high[index]) > std::abs(plot.low[index]) ? plot.high[index] : plot.low[index];
    if (std::isfinite(value))
      out += fmt::format("<circle class=\"worst\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>", x(plot.t_s[index]),
                         y(value));
  }
  out += frame();
  out += text_at(left - 6, top - 9, "end", plot.unit);
  return out + "</svg>";
}

std::string svg(const FlagPlot& plot) {
  if (plot.rows.empty()) return "<p class=\"note\">nothing to show</p>";
  const Axis x{0, std::max(plot.end_s, 1e-3), left, right};
  std::string out = begin(plot.title);
  const double height_of_row = (bottom - top) / static_cast<double>(plot.rows.size());
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const double at = top + height_of_row * (static_cast<double>(i) + 0.5),
                 half = std::min(0.2 * height_of_row, 7.0);
    out += line("rule", left, at + half, right, at + half);
    out += text_at(left + 2, at - half - 2, "start", plot.rows[i].label);
    std::string bars;
    for (const auto& [from_s, to_s] : plot.rows[i].set_s)
      bars += fmt::format("M{:.1f} {:.1f}V{:.1f}H{:.1f}V{:.1f}Z", x(from_s), at + half, at - half,
                          std::max(x(to_s), x(from_s) + 0.5), at + half);
    if (!bars.empty()) out += fmt::format("<path class=\"bars\" d=\"{}\"/>", bars);
  }
  return out + time_marks(x) + frame() + "</svg>";
}

}  // namespace canhil::report
