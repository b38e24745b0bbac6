#include "bench/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/svg.hpp"

namespace canhil::report {

using namespace sketch;

namespace {

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

}  // namespace

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
  std::string out = begin(plot.title, "plot");
  for (const double value : decades(0, y.to)) {
    out += line(stroke("rule"), left, y(std::log10(value)), right, y(std::log10(value)));
    out += text_at(left - 6, y(std::log10(value)) + 4, "end", fmt::format("{:g}", value));
  }
  double last_label = -100;
  for (const double value : decades(x.from, x.to)) {
    const double at = x(std::log10(value));
    out += line(stroke("soft"), at, bottom, at, bottom + 5);
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
  out += fmt::format("<path class=\"bars\" fill=\"{}\" d=\"{}\"/>", paint("line"), bars);
  double last_mark = -100;
  for (const HistogramPlot::Mark& mark : plot.marks) {
    const double at = x(std::log10(std::max(mark.at_us, 1.0)));
    out += line(stroke("warn", "stroke-width=\"1.5\" stroke-dasharray=\"2 3\""), at, top - 4, at, bottom);
    if (at - last_mark <= 30) continue;
    out += text_at(std::min(at, right - 8), top - 9, "middle", mark.label);
    last_mark = at;
  }
  return out + frame() + name_below("time (logarithmic); height: how many (logarithmic)") + "</svg>";
}

std::string svg(const FlagPlot& plot) {
  if (plot.rows.empty()) return "<p class=\"note\">nothing to show</p>";
  const Axis x{0, std::max(plot.end_s, 1e-3), left, right};
  std::string out = begin(plot.title, "plot");
  const double height_of_row = (bottom - top) / static_cast<double>(plot.rows.size());
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const double at = top + height_of_row * (static_cast<double>(i) + 0.5),
                 half = std::min(0.2 * height_of_row, 7.0);
    out += line(stroke("rule"), left, at + half, right, at + half);
    out += text_at(left + 2, at - half - 2, "start", plot.rows[i].label);
    std::string bars;
    for (const auto& [from_s, to_s] : plot.rows[i].set_s)
      bars += fmt::format("M{:.1f} {:.1f}V{:.1f}H{:.1f}V{:.1f}Z", x(from_s), at + half, at - half,
                          std::max(x(to_s), x(from_s) + 0.5), at + half);
    out += fmt::format("<path class=\"bars\" fill=\"{}\" d=\"{}\"/>", paint("line"), bars);
  }
  return out + marks_below(x) + name_below("s") + frame() + "</svg>";
}

}  // namespace canhil::report
