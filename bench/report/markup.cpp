#include "bench/report/markup.hpp"

#include <fmt/format.h>

#include "dbc/text/escape.hpp"

namespace canhil::report {

std::string escaped(std::string_view plain) { return for_markup(plain); }

std::string table(const std::vector<std::string>& head, const Rows& rows, std::string_view style) {
  std::string out = fmt::format("<table class=\"{}\"><thead><tr>", style);
  for (const std::string& cell : head) out += fmt::format("<th>{}</th>", cell);
  out += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      out += fmt::format("<td data-label=\"{}\">{}</td>", head[i], row[i]);
    out += "</tr>\n";
  }
  return out + "</tbody></table>\n";
}

std::string figure(std::string_view title, std::string_view drawing, std::string_view note,
                   std::string_view id) {
  return fmt::format("<figure{}><h3>{}</h3>{}<figcaption>{}</figcaption></figure>\n",
                     id.empty() ? "" : fmt::format(" id=\"{}\"", id), escaped(title), drawing, escaped(note));
}

std::string whole_page(std::string_view title, EmbeddedFiles styles, std::string_view body) {
  std::string style;
  for (const EmbeddedFile& one : styles) style += one.text;
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{}</title>"
      "<style>\n{}</style></head><body>\n{}</body></html>\n",
      title, style, body);
}

}  // namespace canhil::report
