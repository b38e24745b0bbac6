#include "bench/report/page_results.hpp"

#include <vector>

#include "bench/report/page_parts.hpp"
#include "bench/report/page_plots.hpp"

namespace canhil::report {
using Json = nlohmann::ordered_json;

bool has_results(const Json& report) { return report.contains("results"); }

std::string results_section(const Json& report) {
  if (!has_results(report)) return "";
  std::string out = "<section id=\"results\"><h2>Results</h2>\n";
  for (const auto& [estimator, lines] : report.at("results").items()) {
    std::vector<std::vector<std::string>> rows;
    for (const Json& line : lines) {
      std::string words;
      for (const Json& figure : line.at("figures")) {
        const std::string one = text_in(figure.at("words"));
        if (!one.empty()) words += (words.empty() ? "" : ", ") + one;
      }
      rows.push_back({text_in(line.at("what")), words.empty() ? "none" : words});
    }
    out += fmt::format("<h3>{}</h3>\n", escaped(estimator)) + table({"what", "value"}, rows, "pairs");
  }
  return out + "</section>\n";
}

std::string estimates_section(const Json& report) {
  if (report.at("series").empty()) return "";
  std::string out = "<section id=\"estimates\"><h2>Estimates against the truth</h2>\n";
  std::string estimator;
  for (const Json& series : report.at("series")) {
    const std::string own = series.at("estimator").get<std::string>();
    if (own != estimator) {
      if (!estimator.empty()) out += "</div>\n";
      out += fmt::format("<h3>{}</h3>\n<div class=\"grid\">\n", escaped(own));
      estimator = own;
    }
    out += estimate(series);
  }
  return out + "</div></section>\n";
}

}  // namespace canhil::report
