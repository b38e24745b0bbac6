#include "bench/report/page_parts.hpp"

#include <fmt/format.h>

namespace canhil::report {
namespace {

// An object in a list is labelled by its role or, if it has no role, by its bus.
const char* item_key(const Json& item) { return item.contains("role") ? "role" : "bus"; }
std::string item_name(const Json& item) { return item.value(item_key(item), "?"); }
Json without_name(Json item) {
  item.erase(item_key(item));
  return item;
}

// Nested objects as rows "a: b".
void add_rows(Rows& rows, const std::string& name, const Json& value) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      add_rows(rows, name.empty() ? key : fmt::format("{}: {}", name, key), inner);
  } else if (value.is_array()) {
    // The rows of a file are labelled by the role of the file; the rows of an adapter are labelled by its
    // bus.
    if (!value.empty() && value.front().is_object()) {
      for (const Json& item : value)
        add_rows(rows, fmt::format("{}: {}", name, item_name(item)), without_name(item));
      return;
    }
    std::string list;
    for (const Json& item : value) list += (list.empty() ? "" : ", ") + text_in(item);
    rows.push_back({escaped(name), list.empty() ? "none" : list});
  } else {
    rows.push_back({escaped(name), text_in(value)});
  }
}

}  // namespace

std::string outcome_words(std::string_view outcome, std::string_view words) {
  const auto [style, sign] = look_of(outcome);
  return coloured(style, fmt::format("{} {}", sign, words.empty() ? escaped(outcome) : words));
}

std::string head(std::string_view title, std::string_view about) {
  return fmt::format("<h1>{}</h1>\n<p class=\"sub\">{}</p>\n", breakable(escaped(title)), breakable(about));
}

std::string verdict(std::string_view outcome, std::string_view reason) {
  return fmt::format("<p class=\"verdict {}\"><big>{}</big> &nbsp; {}</p>\n", look_of(outcome).style,
                     outcome_words(outcome), escaped(reason));
}

std::string links(const std::vector<std::pair<std::string, std::string>>& sections) {
  std::string out;
  for (const auto& [id, title] : sections)
    out += fmt::format("<a href=\"#{}\">{}</a> &nbsp; ", id, escaped(title));
  return fmt::format("<nav>{}</nav>\n", out);
}

std::string section(std::string_view id, std::string_view title, std::string_view content) {
  return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, escaped(title), content);
}

std::string grid(std::string_view figures) {
  return fmt::format("<div class=\"grid\">\n{}</div>\n", figures);
}

std::string not_known(std::string_view what) {
  return fmt::format("<p>{}</p>\n", coloured("unknown", "? " + escaped(what)));
}

std::string judgements(const std::vector<Judged>& all) {
  Rows rows;
  for (const Judged& one : all) {
    std::string name = escaped(one.name);
    if (!one.link.empty()) name = fmt::format("<a href=\"#{}\">{}</a>", one.link, name);
    const std::string requirement = one.requirement.empty() ? "" : " &middot; " + escaped(one.requirement);
    rows.push_back(
        {name, outcome_words(one.outcome), escaped(one.measured), escaped(one.expected) + requirement});
    if (!one.more.empty()) rows.push_back({one.more});
  }
  return table({"check", "outcome", "measured", "expected"}, rows);
}

std::string facts(const Json& object) {
  Rows rows;
  add_rows(rows, "", object);
  return table({"what", "value"}, rows, "pairs");
}

}  // namespace canhil::report
