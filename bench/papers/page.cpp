#include "bench/papers/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bench/papers/styles.hpp"
#include "bench/report/markup.hpp"

namespace canhil::papers {
namespace {

using report::escaped;

// Keeps times such as "14.7 / 16.2 / never" on one line.
std::string unbroken(std::string cell) {
  for (auto at = cell.find(" / "); at != std::string::npos; at = cell.find(" / ", at))
    cell.replace(at, 3, "&nbsp;/&nbsp;");
  return cell;
}

Result<std::string> html(const std::string& paragraph) {
  return fmt::format("<p>{}</p>\n", escaped(paragraph));
}

Result<std::string> html(const Table& table) {
  std::vector<std::string> head;
  for (const std::string& name : table.head) head.push_back(escaped(name));
  std::vector<std::vector<std::string>> rows;
  for (const Table::Row& row : table.rows) {
    std::vector<std::string>& cells = rows.emplace_back();
    for (const std::string& cell : row.cells) cells.push_back(unbroken(escaped(cell)));
    if (!row.mark.empty())
      cells.back() = fmt::format("<span class=\"{}\">{}</span>", row.mark, escaped(row.cells.back()));
  }
  const std::string note =
      table.note.empty() ? "" : fmt::format("<p class=\"note\">{}</p>\n", escaped(table.note));
  return report::table(head, rows) + note;
}

Result<std::string> html(const Figure& figure) {
  std::string drawings;
  for (const auto& [width, name] : {std::pair{Width::desktop, "wide"}, std::pair{Width::phone, "narrow"}}) {
    auto drawn = draw(figure, width);
    if (!drawn) return drawn;
    drawings += fmt::format("\n<div class=\"{}\" role=\"img\" aria-label=\"{}\">{}</div>", name,
                            escaped(figure.title), *drawn);
  }
  return report::figure(
      figure.title, drawings + "\n",
      figure.caption +
          (has_ranges(figure) ? " Error bars: 95 % range of the RMS, by the scatter over the runs." : ""),
      figure.id);
}

std::size_t width_of(std::string_view text) {  // in characters of UTF-8, not bytes
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0b1100'0000U) != 0b1000'0000U; }));
}

std::string text(const Table& table) {
  std::vector<std::size_t> widths(table.head.size(), 0);
  const auto widen = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) widths[i] = std::max(widths[i], width_of(cells[i]));
  };
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string out = " ";
    for (std::size_t i = 0; i + 1 < cells.size(); ++i)
      out += " " + cells[i] + std::string(widths[i] - width_of(cells[i]) + 1, ' ');
    return out + " " + cells.back() + "\n";
  };
  widen(table.head);
  for (const Table::Row& row : table.rows) widen(row.cells);
  std::string out = line(table.head);
  for (const Table::Row& row : table.rows) out += line(row.cells);
  return out;
}

}  // namespace

Result<std::string> html(const Page& page) {
  std::string out = fmt::format("<h1>{}</h1>\n<p class=\"sub\">{}</p>\n<nav><ul>\n", escaped(page.title),
                                escaped(page.subtitle));
  for (const Section& section : page.sections)
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escaped(section.title));
  out += "</ul></nav>\n";
  for (const Section& section : page.sections) {
    out += fmt::format("<section id=\"{}\"><h2>{}</h2>\n", section.id, escaped(section.title));
    for (const auto& part : section.parts) {
      auto drawn = std::visit([](const auto& one) { return html(one); }, part);
      if (!drawn) return drawn;
      out += *drawn;
    }
    out += "</section>\n";
  }
  return report::whole_page(escaped(page.title), styles, out);
}

std::string text(const Page& page) {
  std::string out = page.title + "\n" + page.subtitle + "\n";
  for (const Section& section : page.sections) {
    bool named = false;
    for (const auto& part : section.parts) {
      const auto* table = std::get_if<Table>(&part);
      if (table == nullptr) continue;
      if (!named) out += "\n" + section.title + "\n";
      named = true;
      out += text(*table);
    }
  }
  return out;
}

}  // namespace canhil::papers
