#include "bench/report/page_parts.hpp"

namespace canhil::report {

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                  std::string_view style) {
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

std::string figure(const std::string& title, const std::string& drawing, const std::string& note) {
  return fmt::format("<figure><h3>{}</h3>{}<figcaption>{}</figcaption></figure>\n", escaped(title), drawing,
                     escaped(note));
}

std::string ms(const nlohmann::ordered_json& distribution, const char* key) {
  return fmt::format("{:.3f}", distribution.at(key).get<double>() * 1e3);
}

}  // namespace canhil::report
