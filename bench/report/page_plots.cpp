#include "bench/report/run_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "bench/report/plot.hpp"

namespace canhil::report {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();  // null in the report

// The numbers of an array, padded with NaN to the length `size`, the number of points in time.
std::vector<double> numbers(const Json& array, std::size_t size) {
  std::vector<double> values;
  for (const Json& value : array) values.push_back(value.is_null() ? not_there : value.get<double>());
  values.resize(size, not_there);
  return values;
}

// The indices of a part of a course; `last` is excluded.
struct Part {
  std::size_t first = 0, last = 0;
};

LinePlot cut(LinePlot plot, const Part& part) {
  for (std::vector<double>* values : {&plot.t_s, &plot.low, &plot.high, &plot.limit, &plot.truth}) {
    if (values->empty()) continue;
    values->resize(part.last);
    values->erase(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(part.first));
  }
  plot.begins_at_first = true;
  std::erase_if(plot.bars, [&](const LinePlot::Bar& bar) { return bar.to_s < plot.t_s.front(); });
  std::erase_if(plot.worst, [&](const LinePlot::Ring& ring) {
    return ring.t_s < plot.t_s.front() || ring.t_s > plot.t_s.back();
  });
  return plot;
}

// A plotted course. If `around_zero` is set (for errors and innovations), the range of the plot includes
// zero.
struct Course {
  LinePlot plot;
  bool around_zero = false;

  void include(Extent& extent, std::size_t i) const {
    if (around_zero) extent.add(0);
    extent.add(plot.low[i]);
    extent.add(plot.high[i]);
    if (!plot.truth.empty()) extent.add(plot.truth[i]);
  }
};

constexpr double hidden = 0.1;  // a smaller fraction of the picture's height is not visible

// The last part of a course, which gets a separate picture: the values near those of the last quarter. None:
// the picture of the whole course already shows these values well. A check's limit that the picture of the
// whole course would hide counts as a value of the last quarter.
std::optional<Part> late_course(const Course& course) {
  constexpr double shown_times = 2.5;  // range of the second picture relative to the late values
  const std::vector<double>& t_s = course.plot.t_s;
  if (t_s.size() < 4) return std::nullopt;
  const double late_s = t_s.back() - (t_s.back() - t_s.front()) / 4;
  Extent all, late;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    course.include(all, i);
    if (t_s[i] >= late_s) course.include(late, i);
  }
  if (!(late.high >= late.low)) return std::nullopt;  // no values at that time
  for (const LinePlot::Bar& bar : course.plot.bars) {
    if (2 * bar.below > hidden * all.size()) continue;
    late.add(bar.below);
    if (!course.plot.from_zero) late.add(-bar.below);
  }
  if (late.size() > hidden * all.size()) return std::nullopt;
  const double least = 1e-6 * std::max(std::abs(late.high), std::abs(late.low));
  Extent shown = late;
  std::size_t first = t_s.size();
  while (first > 0) {
    course.include(shown, first - 1);
    if (shown.size() > shown_times * std::max(late.size(), least)) break;
    --first;
  }
  if (first == 0 || first == t_s.size()) return std::nullopt;
  return Part{.first = first, .last = t_s.size()};
}

// The part of a course for which checks have limits, if the picture of the whole course would hide them.
// None: the picture of the whole course shows the limits, or a picture of this part would not be much finer.
std::optional<Part> judged_course(const Course& course) {
  constexpr double finer = 0.5;
  const LinePlot& plot = course.plot;
  if (plot.bars.empty()) return std::nullopt;
  const double from_s = std::ranges::min(plot.bars, {}, &LinePlot::Bar::from_s).from_s;
  const double to_s = std::ranges::max(plot.bars, {}, &LinePlot::Bar::to_s).to_s;
  const double lowest = std::ranges::min(plot.bars, {}, &LinePlot::Bar::below).below;
  const Part part{
      .first = static_cast<std::size_t>(std::ranges::lower_bound(plot.t_s, from_s) - plot.t_s.begin()),
      .last = static_cast<std::size_t>(std::ranges::upper_bound(plot.t_s, to_s) - plot.t_s.begin())};
  if (part.last < part.first + 2) return std::nullopt;
  const double all = extent_of(plot).size();
  if (2 * lowest > hidden * all || extent_of(cut(plot, part)).size() > finer * all) return std::nullopt;
  return part;
}

// When the worst of the values came that a check judged; none: it is not known.
std::optional<double> worst_of(const std::string& check, const Json& checks) {
  for (const Json& one : checks) {
    if (one.at("name") == check && one.contains("worst_at_s")) return one.at("worst_at_s").get<double>();
  }
  return std::nullopt;
}

// Adds the limits of checks to the plot, and when the worst values came.
void add_bars(const Json& series, const Json& checks, LinePlot& plot) {
  if (!series.contains("bars")) return;
  for (const Json& bar : series.at("bars")) {
    LinePlot::Bar own{.below = bar.at("below").get<double>(),
                      .from_s = bar.at("from_s").get<double>(),
                      .to_s = bar.at("to_s").get<double>()};
    const std::string check = bar.at("check").get<std::string>();
    const std::string statistic = bar.at("statistic").get<std::string>();
    own.name = fmt::format("limit of '{}': {}{:g} {} from {:g} to {:g}\u00a0s", check,
                           statistic == "max" ? "" : statistic + " below ", own.below, plot.unit, own.from_s,
                           own.to_s);
    plot.bars.push_back(std::move(own));
    if (const auto worst_s = worst_of(check, checks))
      plot.worst.push_back(
          {.t_s = *worst_s,
           .name = fmt::format("the largest that '{}' judged, at {:g}\u00a0s", check, *worst_s)});
  }
}

// Shades the times of faults, if these are not the whole run.
void add_faults(const Json& report, LinePlot& plot) {
  if (!report.contains("faults")) return;
  const double end_s = report.at("duration_s").get<double>();
  for (const Json& fault : report.at("faults")) {
    LinePlot::Band band{.times_s = {},
                        .name = fmt::format("fault '{}'", fault.at("name").get<std::string>())};
    for (const Json& window : fault.at("windows")) {
      const double from_s = window.at("from_s").get<double>(), to_s = window.at("to_s").get<double>();
      if (from_s > 0 || to_s < end_s) band.times_s.emplace_back(from_s, to_s);
    }
    if (!band.times_s.empty()) plot.bands.push_back(std::move(band));
  }
}

// Which limits of checks the picture does not show.
std::string beyond_words(const LinePlot& plot) {
  std::string words;
  for (const LinePlot::Bar& bar : plot.bars) {
    if (!shows(plot, bar)) words += (words.empty() ? "beyond this picture: " : "; ") + bar.name;
  }
  return words;
}

std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : "; ") + b;
}

bool any_value(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double v) { return std::isfinite(v); });
}

// Adds the truth, the sigmas or the levels of a series to the plot, and names the curves. Returns what the
// names do not say.
std::string add_lines(const Json& series, LinePlot& plot) {
  const std::size_t size = plot.t_s.size();
  plot.name = "value";
  if (series.contains("truth")) {
    plot.truth = numbers(series.at("truth"), size);
    plot.truth_name = "truth";
    const bool any_truth = any_value(plot.truth);
    const bool is_plants = series.at("estimator") == "plant";
    plot.name = is_plants ? "output of the plant" : any_truth ? "estimate" : "as reported; it has no truth";
    if (!any_truth) plot.truth.clear();
  } else if (series.contains("sigma")) {
    plot.name = "estimate less truth";
    plot.limit_name = "\u00b13 sigma, as reported";
    plot.limit = numbers(series.at("sigma"), size);
    for (double& sigma : plot.limit) sigma *= 3;
    if (any_value(plot.limit)) return "";
    plot.limit.clear();
    plot.from_zero = std::ranges::none_of(plot.low, [](double v) { return v < 0; });  // true for a norm
    return "the target reports no sigma for it";
  } else if (series.contains("between_95_percent")) {
    plot.levels = numbers(series.at("between_95_percent"), series.at("between_95_percent").size());
    plot.levels_name = "between: 95 % of the values of a consistent filter";
  }
  return "";
}

}  // namespace

std::string histogram(const std::string& title, const Json& distribution) {
  HistogramPlot plot{.title = title, .bars = {}, .marks = {}};
  for (const Json& bucket : distribution.at("buckets_us")) {
    const auto from_us = bucket.at(0).get<std::int64_t>();
    const std::int64_t width_us = checks::bucket_width_us(from_us);
    const double to_us =
        width_us > 0 ? static_cast<double>(from_us + width_us) : distribution.at("max").get<double>() * 1e6;
    plot.bars.push_back({static_cast<double>(from_us), to_us, bucket.at(1).get<double>()});
  }
  for (const char* key : {"p50", "p99", "max"})
    plot.marks.push_back({key, distribution.at(key).get<double>() * 1e6});
  return figure(title, svg(plot),
                fmt::format("p50 {}, p99 {}, p99.9 {}, max {} ms of {}", ms(distribution, "p50"),
                            ms(distribution, "p99"), ms(distribution, "p999"), ms(distribution, "max"),
                            distribution.at("count").dump()));
}

std::string from_zero(const std::string& title, const std::string& unit, double stretch_s,
                      const Json& largest, double scale) {
  LinePlot plot{.title = title,
                .unit = unit,
                .t_s = {},
                .low = {},
                .high = {},
                .from_zero = true,
                .name = fmt::format("the largest of each {:g} {}",
                                    stretch_s < 1 ? stretch_s * 1e3 : stretch_s, stretch_s < 1 ? "ms" : "s")};
  for (const Json& value : largest) {
    plot.t_s.push_back((static_cast<double>(plot.t_s.size()) + 0.5) * stretch_s);
    plot.low.push_back(value.is_null() ? not_there : 0.0);
    plot.high.push_back(value.is_null() ? not_there : value.get<double>() * scale);
  }
  return drawn(plot);
}

std::string course(const std::string& title, const Json& line) {
  const double stretch_s = line.at("stretch_s").get<double>();
  return figure(title, from_zero(title, "ms", stretch_s, line.at("largest_s"), 1e3), "");
}

std::string flags(const Json& all, const std::string& estimator, double end_s) {
  constexpr std::size_t most_rows = 8;
  std::string out;
  FlagPlot plot{.title = "Flags", .rows = {}, .end_s = end_s};
  const auto show = [&] {
    if (!plot.rows.empty()) out += figure("Flags", svg(plot), "bars: set");
    plot.rows.clear();
  };
  for (const Json& flag : all) {
    if (flag.at("estimator").get<std::string>() != estimator) continue;
    FlagPlot::Row row{.label = flag.at("name").get<std::string>(), .set_s = {}};
    std::optional<double> since_s;
    for (const Json& change : flag.at("changes")) {
      const double t_s = change.at(0).get<double>();
      if (change.at(1).get<bool>())
        since_s = t_s;
      else if (since_s)
        row.set_s.emplace_back(*std::exchange(since_s, std::nullopt), t_s);
    }
    if (since_s) row.set_s.emplace_back(*since_s, end_s);
    if (row.set_s.empty()) continue;
    plot.rows.push_back(std::move(row));
    if (plot.rows.size() == most_rows) show();
  }
  show();
  return out;
}

std::string estimate(const Json& series, const Json& report, std::string_view id) {
  const std::string kind = series.at("kind").get<std::string>();
  const std::string title = series.at("quantity").get<std::string>();
  const std::size_t size = series.at("t_s").size();
  Course course{.plot = {.title = title,
                         .unit = series.at("unit").get<std::string>(),
                         .t_s = numbers(series.at("t_s"), size),
                         .low = numbers(series.at("low"), size),
                         .high = numbers(series.at("high"), size),
                         .from_zero = kind == "statistic"},
                .around_zero = kind == "error" || kind == "innovation"};
  LinePlot& plot = course.plot;
  const std::string note = add_lines(series, plot);
  add_bars(series, report.at("checks"), plot);
  add_faults(report, plot);
  std::string out = figure(title, drawn(plot), joined(note, beyond_words(plot)), id);
  if (kind == "statistic") return out;
  auto part = late_course(course);
  if (!part) part = judged_course(course);
  if (!part) return out;
  const LinePlot second = cut(plot, *part);
  const bool to_the_end = part->last == size;
  const std::string when = to_the_end
                               ? fmt::format("from {:g} s on", second.t_s.front())
                               : fmt::format("from {:g} to {:g} s", second.t_s.front(), second.t_s.back());
  const Extent shown = extent_of(second);
  const bool band_beyond = !second.limit.empty() && std::ranges::none_of(second.limit, [&](double limit) {
    return limit <= std::max(shown.high, -shown.low);
  });
  const std::string finer =
      fmt::format("the axis is {:.0f} times as fine{}", extent_of(plot).size() / shown.size(),
                  band_beyond ? "; 3 sigma lies beyond this picture" : "");
  return out + figure(fmt::format("{}, {}", title, when), drawn(second), joined(finer, beyond_words(second)));
}

}  // namespace canhil::report
