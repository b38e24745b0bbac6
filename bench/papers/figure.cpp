#include "bench/papers/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bench/papers/gnuplot.hpp"

namespace canhil::papers {
namespace {

struct Layout {
  int width, height;             // [px]
  int left, right, top, bottom;  // margins [px]
  int font;                      // [px]
  int x_steps;                   // approximate number of grid steps
};
constexpr Layout desktop{
    .width = 800, .height = 440, .left = 76, .right = 0, .top = 14, .bottom = 58, .font = 15, .x_steps = 10};
constexpr Layout phone{
    .width = 390, .height = 410, .left = 62, .right = 0, .top = 12, .bottom = 54, .font = 13, .x_steps = 4};

// Returns a step for a grid of approximately `steps` steps: 1, 2 or 5 times a power of ten.
double grid_step(double length, int steps) {
  const double wanted = length / steps;
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (wanted <= digit * power * 1.001) return digit * power;
  }
  return 10 * power;
}

// Sets the right margin so that the names of the curves and their markers fit.
Layout with_room_for_labels(Layout layout, const Figure& figure) {
  std::size_t longest = 0;
  for (const Curve& curve : figure.curves) longest = std::max(longest, curve.label.size());
  // Width of a character divided by the font size. The reader's sans-serif font may be wide: in DejaVu Sans,
  // the characters of the word 'combined' have a mean width of 0.62.
  constexpr double character_width = 0.68;
  layout.right = 34 + static_cast<int>(character_width * layout.font * static_cast<double>(longest));
  return layout;
}

// The colours of Okabe and Ito, darkened for a white page. Dashes and markers distinguish the curves without
// colour.
constexpr std::array colours{"#000000", "#0072B2", "#B5460F", "#007A5A",
                             "#9C4A86", "#6B5B00", "#4A4A4A", "#3E7FB0"};
constexpr std::array dashes{"solid",  "(9,4)", "(3,3)",         "(12,3,3,3)",
                            "(18,5)", "(2,5)", "(9,3,3,3,3,3)", "(5,2)"};
constexpr std::array markers{7, 4, 9, 6, 11, 5, 8, 12};

double on_axis(double y, const Figure& figure) {  // 0 at the lower end, 1 at the upper
  const auto [low, high] = figure.y_range;
  const double share =
      figure.logarithmic ? std::log(y / low) / std::log(high / low) : (y - low) / (high - low);
  return std::clamp(share, 0.0, 1.0);
}

// Moves labels apart so that they do not overlap, as close to the curves' ends as possible.
std::vector<double> spread(const std::vector<double>& wanted, double gap) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return wanted[i]; });
  std::vector<double> placed = wanted;
  constexpr int rounds = 200;  // in each round, overlapping neighbours move apart
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 1; i < order.size(); ++i) {
      double &below = placed[order[i - 1]], &above = placed[order[i]];
      const double missing = gap - (above - below);
      if (missing <= 0) continue;
      below -= missing / 2;
      above += missing / 2;
    }
    for (double& y : placed) y = std::clamp(y, 0.0, 1.0);
  }
  return placed;
}

std::string data_block(std::size_t index, const Curve& curve, const Figure& figure) {
  std::string block = fmt::format("$c{} << EOD\n", index);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const auto& [x, y] = curve.points[i];
    if (x < figure.x_range.first || x > figure.x_range.second || !std::isfinite(y)) continue;
    if (figure.logarithmic && !(y > 0)) continue;
    const auto [low, high] = i < curve.ranges.size() ? curve.ranges[i] : std::pair(y, y);
    block += fmt::format("{:.6g} {:.4g} {:.4g} {:.4g}\n", x, y, low, high);
  }
  return block + "EOD\n";
}

std::string labels(const Figure& figure, const Layout& layout) {
  std::string script;
  std::vector<double> ends;
  for (const Curve& curve : figure.curves) {
    const auto last = std::find_if(curve.points.rbegin(), curve.points.rend(),
                                   [&](const auto& p) { return p.first <= figure.x_range.second; });
    ends.push_back(last == curve.points.rend() ? 0 : on_axis(last->second, figure));
  }
  const double height = layout.height - layout.top - layout.bottom;
  const double width = layout.width - layout.left - layout.right;
  const auto at = spread(ends, 1.25 * layout.font / height);
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    script += fmt::format("set arrow from graph 1,{:.4f} to graph {:.4f},{:.4f} nohead lw 0.7 lc rgb '{}'\n",
                          ends[i], 1 + 13 / width, at[i], colours[i]);
    script += fmt::format(
        "set label \"{}\" at graph {:.4f},{:.4f} left point pt {} ps 0.8 lc rgb '{}' offset char 0.7,0 "
        "textcolor rgb '{}'\n",
        figure.curves[i].label, 1 + 17 / width, at[i], markers[i], colours[i], colours[i]);
  }
  for (const double y : figure.thresholds) {
    script += fmt::format(
        "set arrow from graph 0,first {0} to graph 1,first {0} nohead lw 0.8 dt (1,3) lc rgb "
        "'#555555'\nset label \"{0:g}\" at graph 0.01,first {0} offset 0,0.45 textcolor rgb "
        "'#555555'\n",
        y);
  }
  return script;
}

std::string script_of(const Figure& figure, const Layout& layout) {
  std::string script;
  for (std::size_t i = 0; i < figure.curves.size(); ++i) script += data_block(i, figure.curves[i], figure);
  script += fmt::format("set terminal svg size {},{} dynamic enhanced font 'sans-serif,{}' linewidth 1.2\n",
                        layout.width, layout.height, layout.font);
  script += "set encoding utf8\nunset key\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\n";
  script += "set grid lw 0.8 lc rgb '#dcdcdc' dt solid\nset format y '%g'\n";
  if (figure.logarithmic) script += "set logscale y\n";
  const auto screen = [](int px, int of) { return static_cast<double>(px) / of; };
  script += fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n"
      "set tmargin at screen {:.4f}\n",
      screen(layout.left, layout.width), 1 - screen(layout.right, layout.width),
      screen(layout.bottom, layout.height), 1 - screen(layout.top, layout.height));
  const double length = figure.x_range.second - figure.x_range.first;
  script += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset xtics {}\n", figure.x_range.first,
                        figure.x_range.second, figure.y_range.first, figure.y_range.second,
                        grid_step(length, layout.x_steps));
  // Places the names of the axes explicitly: gnuplot would place them next to the tick labels, outside a
  // narrow figure.
  script += fmt::format(
      "set label '{}' at screen {:.4f},{:.4f} center\n"
      "set label '{}' at screen {:.4f},{:.4f} center rotate by 90\n",
      figure.x_label, screen(layout.left + (layout.width - layout.left - layout.right) / 2, layout.width),
      screen(layout.font * 3 / 5, layout.height), figure.y_label, screen(layout.font * 3 / 4, layout.width),
      screen(layout.bottom + (layout.height - layout.top - layout.bottom) / 2, layout.height));
  script += labels(figure, layout) + "plot ";
  const std::size_t count = figure.curves.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Draws about eight markers on each curve, at a different offset for each curve.
    const auto shown =
        static_cast<std::size_t>(std::ranges::count_if(figure.curves[i].points, [&](const auto& p) {
          return p.first >= figure.x_range.first && p.first <= figure.x_range.second;
        }));
    const std::size_t every = std::max<std::size_t>(1, shown / 8);
    script +=
        fmt::format("{}$c{} using 1:2 with lines lw 1.5 dt {} lc rgb '{}', $c{} every {}::{} ",
                    i == 0 ? "" : ", ", i, dashes[i], colours[i], i, every, every * (i + 1) / (count + 1));
    script += fmt::format(
        "{} pt {} ps 0.7 lc rgb '{}'",
        figure.curves[i].ranges.empty() ? "using 1:2 with points" : "using 1:2:3:4 with yerrorbars lw 0.9",
        markers[i], colours[i]);
  }
  return script + "\n";
}

// Prefixes the ids of a drawing, because several drawings share one page.
std::string with_own_names(std::string svg, const std::string& prefix) {
  for (const std::string_view name : {"gpPt", "gpDot", "gnuplot_"}) {
    for (auto at = svg.find(name); at != std::string::npos;
         at = svg.find(name, at + prefix.size() + name.size()))
      svg.insert(at, prefix);
  }
  return svg;
}

}  // namespace

bool has_ranges(const Figure& figure) {
  return std::ranges::any_of(figure.curves, [](const Curve& curve) { return !curve.ranges.empty(); });
}

Result<std::string> draw(const Figure& figure, Width width) {
  const bool narrow = width == Width::phone;
  auto drawn = gnuplot(script_of(figure, with_room_for_labels(narrow ? phone : desktop, figure)));
  if (!drawn) return drawn;
  const auto begin = drawn->find("<svg");  // without the XML declaration
  if (begin == std::string::npos) return failure("gnuplot: drew nothing, expected an SVG");
  return with_own_names(drawn->substr(begin), figure.id + (narrow ? "-n-" : "-w-"));
}

}  // namespace canhil::papers
