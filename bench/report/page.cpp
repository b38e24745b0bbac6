#include "bench/report/page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/report/page_parts.hpp"

namespace canhil::report {
namespace {

// A plot needs one value for each time. This function describes the first array that has another length, and
// returns an empty text if there is none.
std::string length_differs(const Json& report) {
  for (const Json& series : report.at("series")) {
    const std::size_t times = series.at("t_s").size();
    for (const char* key : {"low", "high", "sigma", "truth"}) {
      if (!series.contains(key) || series.at(key).size() == times) continue;
      return fmt::format("{} of '{}' has {} values, expected {}, as many as t_s", key,
                         series.at("quantity").get<std::string>(), series.at(key).size(), times);
    }
  }
  return {};
}

// The results of the run for each estimator.
std::string results_section(const Json& report) {
  if (!report.contains("results")) return "";
  std::string out = "<section id=\"results\"><h2>Results</h2>\n";
  for (const auto& [estimator, lines] : report.at("results").items()) {
    Rows rows;
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

// The estimates and the truth over time.
std::string estimates_section(const Json& report) {
  if (report.at("series").empty()) return "";
  std::string out = "<section id=\"estimates\"><h2>Estimates against the truth</h2>\n";
  std::string estimator;
  const auto end_of = [&](const std::string& of) {
    return of.empty() ? ""
                      : flags(report.at("flags"), of, report.at("duration_s").get<double>()) + "</div>\n";
  };
  std::size_t number = 0;
  for (const Json& series : report.at("series")) {
    const std::string own = series.at("estimator").get<std::string>();
    if (own != estimator) {
      out += end_of(estimator);
      out += fmt::format("<h3>{}</h3>\n<div class=\"grid\">\n", escaped(own));
      estimator = own;
    }
    out += estimate(series, report.at("checks"), series_id(number++));
  }
  return out + end_of(estimator) + "</section>\n";
}

std::string page_of(const Json& report) {
  const std::string verdict = report.at("verdict").get<std::string>();
  const std::string title = escaped(report.at("title").get<std::string>());
  const Json& provenance = report.at("provenance");
  const auto [style, sign] = look_of(verdict);
  std::string out = fmt::format("<h1>{}</h1>\n", title);
  out += fmt::format("<p class=\"sub\">{} &middot; bus {} &middot; {} &middot; {:g} s &middot; {}</p>\n",
                     text_in(provenance.at("scenario")), text_in(provenance.at("bus")),
                     text_in(provenance.at("clock")), report.at("duration_s").get<double>(),
                     text_in(provenance.at("date")));
  out += fmt::format("<p class=\"verdict {}\"><b>{} {}</b>{}</p>\n", style, sign, escaped(verdict),
                     escaped(report.at("reason").get<std::string>()));
  out += "<nav><a href=\"#checks\">checks</a>";
  if (report.contains("results")) out += "<a href=\"#results\">results</a>";
  out += "<a href=\"#timing\">latency and jitter</a>";
  if (!report.at("series").empty()) out += "<a href=\"#estimates\">estimates</a>";
  out += "<a href=\"#bus\">bus</a><a href=\"#provenance\">provenance</a></nav>\n";
  out += checks_section(report) + results_section(report) + timing_section(report) +
         estimates_section(report) + bus_section(report) + provenance_section(report);
  return whole_page(fmt::format("{}: {}", escaped(verdict), title), styles, out);
}

}  // namespace

Result<std::string> html(const Json& document) {
  try {
    if (std::string why = length_differs(document); !why.empty())
      return failure(fmt::format("the report is not whole: {}", why));
    return page_of(document);
  } catch (const Json::exception& error) {
    return failure(fmt::format("the report is not whole: {}", error.what()));
  }
}

}  // namespace canhil::report
