#include "bench/report/page.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/report/json.hpp"
#include "bench/report/markup.hpp"
#include "bench/report/page_results.hpp"
#include "bench/report/page_sections.hpp"
#include "bench/report/whole.hpp"
#include "dbc/files/text_file.hpp"

namespace canhil::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view style = R"(
:root{color-scheme:light dark;--paper:#fff;--ink:#1b1b1b;--soft:#5a5a5a;--rule:#d8d8d8;--line:#0b5394;--fill:#9fc0e4;
 --yes:#00603e;--no:#a32a00;--unknown:#6b5000;--warn:#b03000}
@media (prefers-color-scheme:dark){:root{--paper:#16181b;--ink:#e8e8e8;--soft:#a9adb3;--rule:#3a3e44;--line:#8fc1f7;
 --fill:#31587f;--yes:#6fd3a4;--no:#ff9b78;--unknown:#e6c35c;--warn:#ffa070}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.2rem 1rem 4rem;max-width:64rem;background:var(--paper);color:var(--ink);
 font:1rem/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;overflow-wrap:break-word}
h1{font-size:1.6rem;line-height:1.2;margin:.4rem 0}
h2{font-size:1.25rem;margin:2.2rem 0 .6rem;padding-top:.7rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:1.2rem 0 .3rem}
.sub{color:var(--soft);margin:.2rem 0 1rem}
.verdict{border:2px solid;border-left-width:.8rem;padding:.5rem .9rem;margin:1rem 0;font-size:1.1rem}
.verdict b{margin-right:.5rem}
.yes{color:var(--yes)}.no{color:var(--no)}.unknown{color:var(--unknown)}
td span{font-weight:600;white-space:nowrap}
nav{font-size:.95rem}nav a{margin-right:1rem;white-space:nowrap;color:var(--line)}
table{border-collapse:collapse;width:100%;margin:.6rem 0;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{text-align:left;vertical-align:top;padding:.3rem .7rem .3rem 0;border-bottom:1px solid var(--rule)}
th{border-bottom:2px solid var(--soft);white-space:nowrap}
.pairs td{overflow-wrap:anywhere}
.figures th:not(:first-child),.figures td:not(:first-child){text-align:right}
.pairs td:first-child{width:40%}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,26rem),1fr));gap:.4rem 1.6rem}
figure{margin:.6rem 0;min-width:0}figure h3{margin:0}
figcaption,.note{color:var(--soft);font-size:.85rem}
summary{cursor:pointer;margin:.5rem 0}
svg{display:block;width:100%;height:auto}
svg text{font-size:12px;fill:var(--soft)}
.axis,.tick{fill:none;stroke:var(--soft)}
.rule{stroke:var(--rule)}.zero{stroke:var(--soft)}
.bars{fill:var(--line)}.mark{stroke:var(--warn);stroke-width:1.5;stroke-dasharray:2 3}
.area{fill:var(--fill);stroke:var(--line);stroke-width:1.2;stroke-linejoin:round}
.truth{fill:none;stroke:var(--ink);stroke-width:2;stroke-linecap:round;stroke-dasharray:.1 5}
.bar{fill:none;stroke:var(--ink);stroke-width:2.6}
.limit{fill:none;stroke:var(--warn);stroke-width:1.4;stroke-dasharray:6 4}
@media (max-width:640px){
 thead{display:none}
 tr{display:block;padding:.4rem 0;border-bottom:1px solid var(--rule)}
 td,.figures td:not(:first-child){display:flex;gap:.6rem;border:0;padding:.06rem 0;text-align:left}
 td::before{content:attr(data-label);flex:0 0 7rem;color:var(--soft)}
 td:first-child{font-weight:600}.pairs td:first-child{width:auto}
 td:first-child::before{content:none}
 .figures td:not(:first-child){display:inline-flex;gap:.3rem;margin-right:.8rem}
 .figures td::before{flex:none}
}
)";

constexpr int most_depth = 32;  // a report has 6

// A plot takes its values by the times that they are of. Empty: each has one.
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
  const std::string verdict = report.at("verdict").get<std::string>();
  const std::string title = escaped(report.at("title").get<std::string>());
  const Json& provenance = report.at("provenance");
  const char* kind = verdict == "pass" ? "yes" : verdict == "fail" ? "no" : "unknown";
  const char* sign = verdict == "pass" ? "&#10003;" : verdict == "fail" ? "&#10007;" : "?";
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{0}: {1}</title>"
      "<style>{2}</style></head><body>\n<h1>{1}</h1>\n",
      escaped(verdict), title, style);
  out += fmt::format(
      "<p class=\"sub\">{} &middot; bus {} &middot; {} &middot; {:g} s &middot; {}</p>\n",
      escaped(provenance.at("scenario").get<std::string>()), escaped(provenance.at("bus").get<std::string>()),
      escaped(provenance.at("clock").get<std::string>()), report.at("duration_s").get<double>(),
      escaped(provenance.at("date").get<std::string>()));
  out += fmt::format("<p class=\"verdict {}\"><b>{} {}</b>{}</p>\n", kind, sign, escaped(verdict),
                     escaped(report.at("reason").get<std::string>()));
  out += "<nav><a href=\"#checks\">checks</a>";
  if (has_results(report)) out += "<a href=\"#results\">results</a>";
  out += "<a href=\"#timing\">latency and jitter</a>";
  if (!report.at("series").empty()) out += "<a href=\"#estimates\">estimates</a>";
  out += "<a href=\"#bus\">bus</a><a href=\"#provenance\">provenance</a></nav>\n";
  return out + checks_section(report) + results_section(report) + timing_section(report) +
         estimates_section(report) + bus_section(report) + provenance_section(report) + "</body></html>\n";
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

Result<Json> read_document(const std::string& path) {
  const auto text = read_text_file(path, "a report as JSON", 64 * mebibyte);
  if (!text) return tl::unexpected(text.error());
  // The page is made by calls as deep as the values lie within one another.
  bool too_deep = false;
  const auto shallow = [&too_deep](int depth, Json::parse_event_t /*event*/, const Json& /*value*/) {
    too_deep = too_deep || depth > most_depth;
    return depth <= most_depth;
  };
  Json document = Json::parse(*text, shallow, false);
  if (too_deep) {
    return failure(fmt::format("file '{}': values lie {} deep within one another, expected a report", path,
                               most_depth + 1));
  }
  // To the parser a NUL is the end of the text, whatever comes behind.
  if (document.is_discarded() || text->find('\0') != std::string::npos)
    return failure(fmt::format("file '{}': is no JSON, expected a report of hil-bench run --json", path));
  if (!document.is_object() || !document.contains("schema") || document.at("schema") != schema)
    return failure(
        fmt::format("file '{}': is no report, expected one with \"schema\": \"{}\"", path, schema));
  if (const std::string why = why_not_whole(document); !why.empty())
    return failure(fmt::format("file '{}': {}", path, why));
  return document;
}

}  // namespace canhil::report
