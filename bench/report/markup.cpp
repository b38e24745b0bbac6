#include "bench/report/markup.hpp"

#include <fmt/format.h>

#include <cctype>

#include "bench/report/palette.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::report {
namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
// The first byte of a character of UTF-8.
bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0b1100'0000U) != 0b1000'0000U; }

// The bytes of a tag or an entity at the begin of a text of HTML; 0: there is none.
std::size_t unit_at(std::string_view html) {
  if (html.front() == '<') return html.find('>') == std::string_view::npos ? 0 : html.find('>') + 1;
  constexpr std::size_t longest_entity = 10;
  const std::size_t end =
      html.front() == '&' ? html.substr(0, longest_entity).find(';') : std::string_view::npos;
  return end == std::string_view::npos ? 0 : end + 1;
}

std::string texts_of(EmbeddedFiles files) {
  std::string all;
  for (const EmbeddedFile& one : files) all += one.text;
  return all;
}

}  // namespace

std::string escaped(std::string_view plain) { return for_markup(plain); }

std::string breakable(std::string_view html, std::size_t few) {
  constexpr std::size_t most = 16;  // characters of a word before a break
  std::string out;
  std::size_t run = 0;  // characters since the last place where the line may break
  char last = ' ';
  while (!html.empty()) {
    const char next = html.front();
    const std::size_t unit = unit_at(html);
    const bool is_tag = unit > 0 && next == '<';
    const bool part_ends = std::string_view("_./:,=-").find(last) != std::string_view::npos ||
                           (is_lower(last) && is_upper(next));
    if (!is_tag && next != ' ' && begins_character(next) && (run >= most || (run >= few && part_ends))) {
      out += "<wbr>";
      run = 0;
    }
    const std::size_t bytes = unit > 0 ? unit : 1;
    out += html.substr(0, bytes);
    if (html.starts_with("<br")) run = 0;
    if (!is_tag) {
      run = next == ' ' || next == '\n' ? 0 : run + (begins_character(next) ? 1 : 0);
      last = unit > 0 ? ' ' : next;
    }
    html.remove_prefix(bytes);
  }
  return out;
}

std::string coloured(std::string_view name, std::string_view html) {
  return fmt::format("<b><font class=\"{}\" color=\"{}\">{}</font></b>", name, light(name), html);
}

std::string table(const std::vector<std::string>& head, const Rows& rows, std::string_view style) {
  const bool figures = style == "figures";
  const std::size_t few = head.size() > 5 ? 2 : 6;  // even numbers, so that many columns fit on a phone
  // A cell of a head is centred unless it says otherwise, any other cell is on the left.
  const auto align = [&](std::size_t column) {
    return figures && column > 0 ? std::string_view(" align=\"right\"") : std::string_view();
  };
  std::string out = fmt::format(
      "<div class=\"box {0}\"><small><table class=\"{0}\" border=\"1\" rules=\"all\" cellpadding=\"{1}\" "
      "width=\"100%\"><thead><tr>",
      style, figures ? 1 : 3);
  for (std::size_t i = 0; i < head.size(); ++i)
    out += fmt::format("<th{}>{}</th>", align(i).empty() ? " align=\"left\"" : align(i),
                       breakable(head[i], few));
  out += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    out += "<tr valign=\"top\">";
    if (row.size() == 1 && head.size() > 1)
      out += fmt::format("<td class=\"wide\" colspan=\"{}\">{}</td>", head.size(), row[0]);
    else
      for (std::size_t i = 0; i < row.size(); ++i)
        out += fmt::format("<td{} data-label=\"{}\">{}</td>", align(i), head[i], breakable(row[i], few));
    out += "</tr>\n";
  }
  return out + "</tbody></table></small></div>\n";
}

std::string folded(std::string_view summary, std::string_view content) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", summary, content);
}

// Not <figure>, whose margins take a quarter of a phone's width without a style sheet.
std::string figure(std::string_view title, std::string_view drawing, std::string_view note,
                   std::string_view id) {
  return fmt::format("<article class=\"figure\"{}><h3>{}</h3>{}{}</article>\n",
                     id.empty() ? "" : fmt::format(" id=\"{}\"", id), escaped(title), drawing,
                     note.empty() ? "" : fmt::format("<p class=\"note\">{}</p>", escaped(note)));
}

std::string whole_page(std::string_view title, EmbeddedFiles styles, std::string_view body,
                       EmbeddedFiles scripts) {
  std::string colours;
  for (const Colour& one : palette) colours += fmt::format("--{}:{};", one.name, one.light);
  const std::string script = texts_of(scripts);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{}</title>"
      "<style>\n:root{{{}}}\n{}</style></head><body>\n{}{}</body></html>\n",
      title, colours, texts_of(styles), body,
      script.empty() ? "" : fmt::format("<script>\n{}</script>\n", script));
}

}  // namespace canhil::report
