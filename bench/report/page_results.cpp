#include "bench/report/page_results.hpp"

#include <vector>

#include "bench/report/page_parts.hpp"
#include "bench/report/page_plots.hpp"
#include "bench/world/units.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;
using world::units::deg;
using world::units::mrad;

std::string or_words(const Json& value, double unit, const char* digits, const char* none) {
  return value.is_null() ? none : fmt::format(fmt::runtime(digits), value.get<double>() / unit);
}

void add_outcomes(Rows& rows, const char* what, const Json& object) {
  if (!object.contains("outcomes")) return;
  std::string words;
  for (const auto& [name, count] : object.at("outcomes").items())
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", escaped(name), count.dump());
  rows.push_back({what, words});
}

std::string alignment(const Json& one) {
  const std::string unit_name = one.value("angle_unit", "mrad");  // older reports have none
  const double unit = unit_name == "deg" ? deg : mrad;
  Rows rows;
  for (const Json& entry : one.at("heading_convergence"))
    rows.push_back({fmt::format("{:g} {}", entry.at("within_mrad").get<double>() * mrad / unit, unit_name),
                    or_words(entry.at("t_s"), 1, "{:.2f} s", "never")});
  std::string out = table({"heading error for good within", "from"}, rows, "pairs");
  rows.clear();
  if (one.contains("final_error")) {
    const Json& error = one.at("final_error");
    for (const char* angle : {"roll", "pitch", "heading"})
      rows.push_back(
          {fmt::format("{} error at the end", angle),
           fmt::format("{:+.3f} {}", error.at(std::string(angle) + "_rad").get<double>() / unit, unit_name)});
    rows.push_back(
        {"velocity error at the end", fmt::format("{:.4f} m/s", error.at("velocity_mps").get<double>())});
  } else {
    out += "<p class=\"no\">&#10007; The target gave no navigation answers.</p>\n";
  }
  if (one.contains("fixes")) {
    const Json& fixes = one.at("fixes");
    add_outcomes(rows, "fixes", fixes);
    rows.push_back({"repairs of the covariance", fixes.at("repairs").dump()});
    if (fixes.contains("resolved_s"))
      rows.push_back({"heading fed back to the INS",
                      or_words(fixes.at("resolved_s"), 1, "at {:g} s", "not by the end")});
    rows.push_back({"heading sigma at the end, as the target tells it",
                    fmt::format("{:.3f} deg", fixes.at("heading_sigma_rad").get<double>() / deg)});
  }
  return rows.empty() ? out : out + table({"what", "value"}, rows, "pairs");
}

std::string engagement(const Json& one) {
  Rows rows;
  rows.push_back({"miss", one.at("miss_m").is_null()
                              ? "the target was not passed"
                              : fmt::format("{:.3f} m at {:.3f} s", one.at("miss_m").get<double>(),
                                            one.at("passage_s").get<double>())});
  if (one.at("late_commands").get<std::uint64_t>() > 0)
    rows.push_back({"answers too late to guide", one.at("late_commands").dump()});
  add_outcomes(rows, "LOS rate answers", one);
  const std::string out = table({"what", "value"}, rows, "pairs");
  rows.clear();
  for (const Json& window : one.at("los_rate_rms"))
    rows.push_back({fmt::format("{:g} to {:g} s", window.at("most_to_go_s").get<double>(),
                                window.at("least_to_go_s").get<double>()),
                    or_words(window.at("rms_radps"), mrad, "{:.2f} mrad/s", "no answers")});
  return out + table({"time to go", "RMS of the LOS rate error"}, rows, "pairs");
}

std::string wind(const Json& one) {
  Rows rows;
  const Json& mean = one.at("mean_error_mps");
  const double from_s = one.at("from_s").get<double>();
  for (const auto& [key, label] :
       {std::pair("norm", "of the vector"), std::pair("along_track", "along track"),
        std::pair("cross_track", "across track"), std::pair("down", "down")})
    rows.push_back({fmt::format("mean |wind error| from {:g} s on, {}", from_s, label),
                    or_words(mean.at(key), 1, "{:.3f} m/s", "none judged")});
  rows.push_back({"sigma along track at the end, as the target tells it",
                  fmt::format("{:.3f} m/s", one.at("along_track_sigma_mps").get<double>())});
  add_outcomes(rows, "wind answers", one);
  return table({"what", "value"}, rows, "pairs");
}

}  // namespace

bool has_results(const Json& report) {
  return report.contains("alignments") || report.contains("engagement") || report.contains("wind");
}

std::string results_section(const Json& report) {
  if (!has_results(report)) return "";
  std::string out = "<section id=\"results\"><h2>Results</h2>\n";
  if (report.contains("engagement")) out += "<h3>los_rate</h3>\n" + engagement(report.at("engagement"));
  if (report.contains("wind")) out += "<h3>wind</h3>\n" + wind(report.at("wind"));
  if (report.contains("alignments")) {
    for (const Json& one : report.at("alignments"))
      out += fmt::format("<h3>{}</h3>\n", text_in(one.at("estimator"))) + alignment(one);
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
