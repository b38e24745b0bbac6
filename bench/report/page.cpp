#include "bench/report/page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/report/run_sections.hpp"

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

std::string page_of(const Json& report) {
  const std::string outcome = report.at("verdict").get<std::string>();
  const std::string title = report.at("title").get<std::string>();
  const Json& provenance = report.at("provenance");
  const std::string about = fmt::format(
      "{} &middot; bus {} &middot; {} &middot; {:g} s &middot; {}", text_in(provenance.at("scenario")),
      text_in(provenance.at("bus")), text_in(provenance.at("clock")), report.at("duration_s").get<double>(),
      text_in(provenance.at("date")));
  const std::string changes = changes_section(report);
  std::vector<std::pair<std::string, std::string>> sections;
  if (!changes.empty()) sections.emplace_back("changes", "faults and changes");
  sections.emplace_back("checks", "checks");
  if (report.contains("results")) sections.emplace_back("results", "results");
  sections.emplace_back("timing", "latency and jitter");
  if (!report.at("series").empty()) sections.emplace_back("estimates", "estimates");
  sections.emplace_back("bus", "bus");
  sections.emplace_back("provenance", "provenance");
  return whole_page(escaped(fmt::format("{}: {}", outcome, title)), styles,
                    head(title, about) + verdict(outcome, report.at("reason").get<std::string>()) +
                        links(sections) + changes + checks_section(report) + results_section(report) +
                        timing_section(report) + estimates_section(report) + bus_section(report) +
                        provenance_section(report),
                    scripts);
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
