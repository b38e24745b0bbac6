#include "bench/papers/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bench/report/markup.hpp"

namespace canhil::papers {
namespace {

using report::escaped;

constexpr std::string_view style = R"(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.2rem 1rem 4rem;max-width:58rem;background:#fff;color:#1a1a1a;
 font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.4rem 0}
h2{font-size:1.25rem;margin:2.6rem 0 .6rem;padding-top:.7rem;border-top:1px solid #ccc}
.sub{color:#555;margin:.2rem 0 1.4rem}
p,li{max-width:46rem}
table{border-collapse:collapse;width:100%;margin:.8rem 0 .3rem;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.34rem .6rem .34rem 0;border-bottom:1px solid #e2e2e2}
th{border-bottom:2px solid #888;font-weight:600;white-space:nowrap}
.note,figcaption{color:#555;font-size:.88rem;margin:.2rem 0 1.2rem;max-width:46rem}
td.yes{color:#00603e}td.no{color:#a32a00}td.partly{color:#6b5000}
td.yes,td.no,td.partly{font-weight:600}
figure{margin:1.6rem 0}
figure h3{font-size:1rem;margin:0 0 .3rem}
figure svg{display:block;width:100%;height:auto}
.narrow{display:none}
nav ul{padding-left:1.1rem;margin:.3rem 0}
a{color:#0a58a6}
@media (max-width:640px){
 .wide{display:none}.narrow{display:block}
 thead{display:none}
 tr{display:block;padding:.5rem 0;border-bottom:1px solid #bbb}
 td{display:flex;gap:.6rem;border:0;padding:.08rem 0}
 td::before{content:attr(data-label);flex:0 0 6.2rem;color:#555;font-weight:400}
 td:first-child{font-weight:600}
 td:first-child::before{content:none}
}
@media print{.narrow{display:none}.wide{display:block}}
)";

// Times "14.7 / 16.2 / never" stay on one line.
std::string unbroken(std::string cell) {
  for (auto at = cell.find(" / "); at != std::string::npos; at = cell.find(" / ", at))
    cell.replace(at, 3, "&nbsp;/&nbsp;");
  return cell;
}

std::string_view css_class(Mark mark) {
  switch (mark) {
    case Mark::yes:
      return "yes";
    case Mark::no:
      return "no";
    case Mark::partly:
      return "partly";
    case Mark::none:
      break;
  }
  return "none";
}

std::string html(const Table& table) {
  std::string out = "<table><thead><tr>";
  for (const std::string& name : table.head) out += fmt::format("<th>{}</th>", escaped(name));
  out += "</tr></thead><tbody>\n";
  for (const Row& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      out += fmt::format("<td data-label=\"{}\">{}</td>", escaped(table.head[i]),
                         unbroken(escaped(row.cells[i])));
    out += fmt::format("<td class=\"{}\" data-label=\"{}\">{}</td></tr>\n", css_class(row.mark),
                       escaped(table.head.back()), escaped(row.verdict));
  }
  out += "</tbody></table>\n";
  if (!table.note.empty()) out += fmt::format("<p class=\"note\">{}</p>\n", escaped(table.note));
  return out;
}

Result<std::string> html(const Figure& figure) {
  auto wide = draw(figure, Width::desktop);
  if (!wide) return wide;
  auto narrow = draw(figure, Width::phone);
  if (!narrow) return narrow;
  return fmt::format(
      "<figure id=\"{}\"><h3>{}</h3>\n<div class=\"wide\" role=\"img\" aria-label=\"{}\">{}</div>\n"
      "<div class=\"narrow\" role=\"img\" aria-label=\"{}\">{}</div>\n<figcaption>{}</figcaption></figure>\n",
      figure.id, escaped(figure.title), escaped(figure.title), *wide, escaped(figure.title), *narrow,
      escaped(figure.caption + (has_ranges(figure)
                                    ? " Error bars: 95 % range of the RMS, by the scatter over "
                                      "the runs."
                                    : "")));
}

std::size_t width_of(std::string_view text) {  // in characters, not bytes, of UTF-8
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0b1100'0000U) != 0b1000'0000U; }));
}

std::string text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& name : table.head) widths.push_back(width_of(name));
  for (const Row& row : table.rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      widths[i] = std::max(widths[i], width_of(row.cells[i]));
  }
  const auto line = [&](const std::vector<std::string>& cells, const std::string& verdict) {
    std::string out = " ";
    for (std::size_t i = 0; i < cells.size(); ++i)
      out += " " + cells[i] + std::string(widths[i] - width_of(cells[i]) + 1, ' ');
    return out + " " + verdict + "\n";
  };
  std::string out = line({table.head.begin(), table.head.end() - 1}, table.head.back());
  for (const Row& row : table.rows) out += line(row.cells, row.verdict);
  return out;
}

}  // namespace

Result<std::string> html(const Page& page) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p class=\"sub\">{2}</p>\n<nav><ul>\n",
      escaped(page.title), style, escaped(page.subtitle));
  for (const Section& section : page.sections)
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escaped(section.title));
  out += "</ul></nav>\n";
  for (const Section& section : page.sections) {
    out += fmt::format("<section id=\"{}\"><h2>{}</h2>\n", section.id, escaped(section.title));
    for (const std::string& paragraph : section.paragraphs)
      out += fmt::format("<p>{}</p>\n", escaped(paragraph));
    for (const Table& table : section.tables) out += html(table);
    for (const Figure& figure : section.figures) {
      auto drawn = html(figure);
      if (!drawn) return drawn;
      out += *drawn;
    }
    out += "</section>\n";
  }
  return out + "</body></html>\n";
}

std::string text(const Page& page) {
  std::string out = page.title + "\n" + page.subtitle + "\n";
  for (const Section& section : page.sections) {
    if (section.tables.empty()) continue;
    out += "\n" + section.title + "\n";
    for (const Table& table : section.tables) out += text(table);
  }
  return out;
}

}  // namespace canhil::papers
