#include "bench/papers/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <stdexcept>
#include <utility>

namespace canhil::papers {
namespace {

using Lines = std::span<const std::string_view>;

[[noreturn]] void wrong(std::string_view line, std::string_view expected) {
  throw std::logic_error(fmt::format("page: '{}': expected {}", line, expected));
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

// Splits a line at the first occurrence of a separator.
std::pair<std::string_view, std::string_view> cut(std::string_view line, std::string_view at) {
  const auto found = line.find(at);
  if (found == std::string_view::npos) wrong(line, fmt::format("'{}'", at));
  return {trimmed(line.substr(0, found)), trimmed(line.substr(found + at.size()))};
}

std::string joined(Lines lines) { return fmt::format("{}", fmt::join(lines, " ")); }

double number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) wrong(text, "a number");
  return value;
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  if (!line.ends_with('|')) wrong(line, "'|' at the end of a row");
  line.remove_prefix(1);
  while (!line.empty()) {
    const auto bar = line.find('|');
    cells.emplace_back(trimmed(line.substr(0, bar)));
    line.remove_prefix(bar + 1);
  }
  return cells;
}

Table::Row row_of(std::string_view line, std::size_t columns) {
  Table::Row row{.cells = cells_of(line), .mark = ""};
  if (row.cells.size() != columns) wrong(line, fmt::format("{} cells", columns));
  std::string& verdict = row.cells.back();
  if (!verdict.starts_with('[')) return row;
  const auto [mark, words] = cut(verdict, "]");
  row.mark = mark.substr(1);
  if (!std::ranges::count(std::array{"yes", "no", "partly"}, row.mark))
    wrong(line, "[yes], [no] or [partly]");
  verdict = std::string(words);
  return row;
}

Table table_of(Lines lines) {
  Table table{.head = cells_of(lines.front()), .rows = {}, .note = ""};
  const auto note = std::ranges::find_if(lines, [](std::string_view line) { return !line.starts_with('|'); });
  for (auto line = lines.begin() + 1; line != note; ++line)
    table.rows.push_back(row_of(*line, table.head.size()));
  table.note = joined({note, lines.end()});
  return table;
}

// Parses the range of an axis, such as "0 to 20".
std::pair<double, double> range_of(std::string_view words) {
  const auto [from, to] = cut(words, " to ");
  return {number_in(from), number_in(to)};
}

Curve curve_of(std::string_view line, const Curves& curves) {
  const auto [label, what] = cut(line, ": ");
  try {
    Words words(what);
    const auto found = curves.find(words.next());
    if (found == curves.end()) throw std::logic_error("is unknown");
    Curve curve = found->second(words);
    if (!words.empty()) throw std::logic_error("has too many words");
    curve.label = label;
    return curve;
  } catch (const std::exception& error) {
    throw std::logic_error(fmt::format("page: curve '{}': {}", what, error.what()));
  }
}

Figure figure_of(Lines lines, const Curves& curves) {
  const auto [id, title] = cut(lines.front(), ": ");
  Figure figure{.id = std::string(cut(id, " ").second), .title = std::string(title), .caption = ""};
  for (lines = lines.subspan(1); !lines.empty(); lines = lines.subspan(1)) {
    const std::string_view line = lines.front();
    if (line.starts_with("curve ")) {
      figure.curves.push_back(curve_of(line.substr(6), curves));
    } else if (line.starts_with("lines ")) {
      for (Words words(line.substr(6)); !words.empty();) figure.thresholds.push_back(number_in(words.next()));
    } else if (line.starts_with("x ")) {
      const auto [range, label] = cut(line.substr(2), ": ");
      figure.x_range = range_of(range);
      figure.x_label = label;
    } else if (line.starts_with("y ")) {
      const auto [range, label] = cut(line.substr(2), ": ");
      constexpr std::string_view logarithmic = ", logarithmic";
      figure.logarithmic = range.ends_with(logarithmic);
      figure.y_range = range_of(range.substr(0, range.find(',')));
      figure.y_label = label;
    } else {
      break;
    }
  }
  if (figure.curves.empty() || figure.x_label.empty() || figure.y_label.empty() || lines.empty())
    wrong(title, "lines of x, y and curves, and a caption");
  figure.caption = joined(lines);
  return figure;
}

}  // namespace

Page page_of(std::string_view text, const Curves& curves) {
  Page page;
  std::vector<std::string_view> block;
  const auto add = [&](Lines lines) {
    const std::string_view first = lines.front();
    if (first.starts_with("# ")) {
      page.title = first.substr(2);
      page.subtitle = joined(lines.subspan(1));
      return;
    }
    if (first.starts_with("## ")) {
      const auto [id, title] = cut(first.substr(3), ": ");
      page.sections.push_back({.id = std::string(id), .title = std::string(title), .parts = {}});
      if (lines.size() > 1) wrong(first, "a blank line behind it");
      return;
    }
    if (page.sections.empty()) wrong(first, "a section before it");
    auto& parts = page.sections.back().parts;
    if (first.starts_with('|')) {
      parts.emplace_back(table_of(lines));
    } else if (first.starts_with("figure ")) {
      parts.emplace_back(figure_of(lines, curves));
    } else {
      parts.emplace_back(joined(lines));
    }
  };
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty()) block.push_back(line);
    if (block.empty() || (!line.empty() && !text.empty())) continue;
    add(block);
    block.clear();
  }
  if (page.title.empty()) wrong(text, "a title");
  return page;
}

}  // namespace canhil::papers
