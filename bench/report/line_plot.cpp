#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report/plot.hpp"
#include "bench/report/rounded.hpp"
#include "bench/report/svg.hpp"

namespace canhil::report {

using namespace sketch;

namespace {

constexpr double limit_room = 2.5;  // limits up to this multiple of the largest value are shown
constexpr double bar_room = 6;      // the same factor for the limits of checks, which matter most

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

// The appearance of a curve. Strokes keep their width when the plot is zoomed.
constexpr std::string_view unscaled = "vector-effect=\"non-scaling-stroke\" stroke-linecap=\"round\"";
std::string curve(std::string_view colour, std::string_view more) {
  return stroke(colour, fmt::format("{} {}", unscaled, more));
}
std::string as_area() {
  return fmt::format("fill=\"{}\" stroke=\"{}\" {} stroke-linejoin=\"round\" stroke-width=\"1.2\"",
                     paint("fill"), paint("line"), unscaled);
}
std::string as_limit() {
  return stroke("warn", "vector-effect=\"non-scaling-stroke\" stroke-width=\"1.4\" stroke-dasharray=\"6 4\"");
}
std::string as_truth() { return curve("ink", "stroke-width=\"2\" stroke-dasharray=\".1 5\""); }
std::string as_bar() { return stroke("ink", "vector-effect=\"non-scaling-stroke\" stroke-width=\"2.6\""); }
std::string as_band() {
  return fmt::format(
      "fill=\"{0}\" fill-opacity=\".16\" stroke=\"{0}\" vector-effect=\"non-scaling-stroke\" "
      "stroke-width=\"1\" stroke-dasharray=\"2 3\"",
      paint("unknown"));
}
std::string as_line(std::size_t number) {
  struct Look {
    std::string_view colour, dashes;
  };
  static constexpr std::array looks{Look{"line", "none"}, Look{"warn", "7 4"}, Look{"yes", "2 4"},
                                    Look{"unknown", "9 3 2 3"}, Look{"ink", "4 4"}};
  const Look& look = looks[number % looks.size()];
  return curve(look.colour, fmt::format("stroke-width=\"1.8\" stroke-dasharray=\"{}\"", look.dashes));
}

// Draws curves in the units of their values, and collects the legend. `base` is subtracted from all values,
// because a browser computes places with seven digits.
class Curves {
 public:
  Curves(const LinePlot& plot, double base) : plot_(plot), base_(base) {}

  // A curve or several, which the legend shows as one. `kind` says to page.js what the values are; empty:
  // none that it shows.
  void add(std::string_view name, const std::string& attributes, std::string_view kind,
           const std::string& path, bool is_filled = false) {
    if (path.empty()) return;
    const std::size_t number = count_++;
    curves_ += fmt::format("<path data-curve=\"{}\"{} {} d=\"{}\"/>", number,
                           kind.empty() ? "" : fmt::format(" data-kind=\"{}\"", kind), attributes, path);
    add_to_legend(number, name,
                  fmt::format("<path {} d=\"{}\"/>", attributes, is_filled ? "M2 3H26V9H2Z" : "M2 6H26"));
  }
  void add_area() {
    std::string path;
    for (const Stretch& stretch : stretches(plot_.t_s.size(), [&](std::size_t i) {
           return std::isfinite(plot_.low[i]) && std::isfinite(plot_.high[i]);
         })) {
      for (std::size_t i = stretch.from; i < stretch.to; ++i) path += point(i, stretch, plot_.high[i]);
      for (std::size_t i = stretch.to; i-- > stretch.from;)
        path += fmt::format("L{}", place(plot_.t_s[i], plot_.low[i]));
      path += 'Z';
    }
    const bool from_nothing =
        plot_.from_zero && std::ranges::none_of(plot_.low, [](double low) { return low > 0; });
    add(plot_.name.empty() ? plot_.title : plot_.name, as_area(), from_nothing ? "top" : "area", path, true);
  }
  void add_values(std::string_view name, const std::string& attributes, std::string_view kind,
                  const std::vector<double>& values) {
    if (values.size() != plot_.t_s.size()) return;
    std::string path = along(values, 1);
    if (kind == "both") path += along(values, -1);
    add(name, attributes, kind, path);
  }
  // A line with a dot at each end: a path of no length, whose round ends do not change with the zoom.
  void add_bar(const LinePlot::Bar& bar, bool below_zero) {
    std::string path, ends;
    for (const double value : {bar.below, -bar.below}) {
      if (value != bar.below && !below_zero) continue;
      path += fmt::format("M{}H{:.7g}", place(bar.from_s, value), bar.to_s);
      ends += fmt::format("M{}h0M{}h0", place(bar.from_s, value), place(bar.to_s, value));
    }
    curves_ += fmt::format("<path data-curve=\"{}\" {} d=\"{}\"/>", count_,
                           curve("ink", "stroke-width=\"8\""), ends);
    add(bar.name, as_bar(), "", path);
  }
  // A ring stays round when the plot is zoomed, so it is outside the zoomed part.
  void add_ring(const LinePlot::Ring& ring, const Axis& x, const Axis& y) {
    const auto later = std::ranges::lower_bound(plot_.t_s, ring.t_s);
    if (later == plot_.t_s.end() || plot_.low.empty()) return;
    // A point of the plot may join several values: the worst one is in the point at or before its time.
    auto index = static_cast<std::size_t>(later - plot_.t_s.begin());
    if (*later > ring.t_s && index > 0) --index;
    const double low = plot_.low[index], high = plot_.high[index];
    const double value = std::abs(high) > std::abs(low) ? high : low;
    if (!std::isfinite(value)) return;
    const std::string look = stroke("ink", "stroke-width=\"1.6\"");
    const std::size_t number = count_++;
    rings_ += fmt::format(
        "<circle data-curve=\"{}\" data-t=\"{}\" data-value=\"{:.7g}\" {} cx=\"{:.1f}\" cy=\"{:.1f}\" "
        "r=\"5\"/>",
        number, plot_.t_s[index], value - base_, look, x(plot_.t_s[index]), y(value));
    add_to_legend(number, ring.name, fmt::format("<circle {} cx=\"14\" cy=\"6\" r=\"5\"/>", look));
  }
  void add_band(const LinePlot::Band& band, const Axis& x, const Axis& y) {
    std::string path;
    for (const auto& [from_s, to_s] : band.times_s) {
      const double from = std::max(from_s, x.from), to = std::min(to_s, x.to);
      if (to < from) continue;
      path += fmt::format("M{}V{}H{:.7g}V{}Z", place(from, y.from), of(y.to), to, of(y.from));
    }
    add(band.name, as_band(), "", path, true);
  }
  void add_levels(const Axis& x) {
    std::string path;
    for (const double level : plot_.levels) path += fmt::format("M{}H{}", place(x.from, level), x.to);
    add(plot_.levels_name, as_limit(), "", path);
  }

  // The curves within the axes.
  [[nodiscard]] std::string drawn(const Axis& x, const Axis& y) const {
    return fmt::format(
               "<svg x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" preserveAspectRatio=\"none\" "
               "viewBox=\"{:.9g} {:.9g} {:.9g} {:.9g}\" data-base=\"{}\"><g transform=\"scale(1 -1)\">{}</g>"
               "</svg>",
               left, top, right - left, bottom - top, x.from, base_ - y.to, x.to - x.from, y.to - y.from,
               base_, curves_) +
           rings_;
  }
  [[nodiscard]] std::string legend() const { return fmt::format("<p class=\"legend\">{}</p>", legend_); }

 private:
  [[nodiscard]] std::string of(double value) const { return fmt::format("{:.7g}", value - base_); }
  [[nodiscard]] std::string place(double t_s, double value) const {
    return fmt::format("{:.7g} {}", t_s, of(value));
  }
  [[nodiscard]] std::string point(std::size_t i, const Stretch& of, double value) const {
    return (i == of.from ? "M" : "L") + place(plot_.t_s[i], value);
  }
  [[nodiscard]] std::string along(const std::vector<double>& values, double sign) const {
    std::string path;
    for (const Stretch& stretch :
         stretches(values.size(), [&](std::size_t i) { return std::isfinite(values[i]); })) {
      for (std::size_t i = stretch.from; i < stretch.to; ++i) path += point(i, stretch, sign * values[i]);
    }
    return path;
  }
  void add_to_legend(std::size_t number, std::string_view name, const std::string& sample) {
    legend_ += fmt::format(
        "<span data-curve=\"{}\"><svg class=\"key\" width=\"28\" height=\"12\">{}</svg> {}</span> &nbsp; ",
        number, sample, escaped(name));
  }

  const LinePlot& plot_;
  double base_;
  std::size_t count_ = 0;
  std::string curves_, rings_, legend_;
};

}  // namespace

Extent extent_of(const LinePlot& plot) {
  Extent own;
  for (const std::vector<double>* values : {&plot.low, &plot.high, &plot.truth})
    for (const double value : *values) own.add(value);
  for (const LinePlot::Line& line : plot.lines)
    for (const double value : line.values) own.add(value);
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

std::string drawn(const LinePlot& plot) {
  const Extent extent = extent_of(plot);
  if (plot.t_s.empty() || !std::isfinite(extent.low)) return "<p class=\"note\">nothing to show</p>";
  const double begins = plot.begins_at_first ? plot.t_s.front() : std::min(plot.t_s.front(), 0.0);
  const Axis x{begins, std::max(plot.t_s.back(), plot.t_s.front() + 1e-3), left, right};
  const double margin = 0.05 * extent.size();
  const Axis y{plot.from_zero ? 0.0 : extent.low - margin, extent.high + margin, bottom, top};
  constexpr double small = 1e-3;  // of the values: their differences need more digits than a browser has
  const double base = extent.size() < small * std::abs(extent.low) ? rounded(extent.low) : 0;
  Curves curves(plot, base);
  for (const LinePlot::Band& band : plot.bands) curves.add_band(band, x, y);
  if (!plot.low.empty()) curves.add_area();
  curves.add_values(plot.limit_name, as_limit(), "both", plot.limit);
  curves.add_values(plot.truth_name, as_truth(), "line", plot.truth);
  for (std::size_t i = 0; i < plot.lines.size(); ++i)
    curves.add_values(plot.lines[i].name, as_line(i), "line", plot.lines[i].values);
  curves.add_levels(x);
  for (const LinePlot::Bar& bar : plot.bars) {
    if (shows(plot, bar)) curves.add_bar(bar, y.from <= -bar.below);
  }
  for (const LinePlot::Ring& ring : plot.worst) curves.add_ring(ring, x, y);
  return begin(plot.title, "plot lines") +
         fmt::format("<g class=\"marks\">{}{}</g>", marks_beside(y), marks_below(x)) + curves.drawn(x, y) +
         frame() + name_below(plot.t_unit) + text_at(left - 6, top - 9, "end", plot.unit) + "</svg>" +
         curves.legend();
}

}  // namespace canhil::report
