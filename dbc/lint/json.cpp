#include <nlohmann/json.hpp>

#include "dbc/lint/lint.hpp"

namespace canhil::dbc {

using nlohmann::ordered_json;

std::string to_json(const std::vector<Linted>& files) {
  ordered_json pages = ordered_json::array();
  for (const Linted& linted : files) {
    ordered_json findings = ordered_json::array();
    for (const Finding& finding : linted.findings) {
      const RuleText& rule = text_of(finding.rule);
      findings.push_back({{"line", finding.at.line},
                          {"column", finding.at.column},
                          {"severity", name_of(rule.severity)},
                          {"rule", rule.id},
                          {"what", finding.what},
                          {"consequence", rule.consequence}});
    }
    pages.push_back({{"file", linted.file},
                     {"loads", linted.loads},
                     {"messages", linted.messages},
                     {"signals", linted.signals},
                     {"findings", findings}});
  }
  // A file name may contain bytes that are not UTF-8; dump() replaces them.
  return ordered_json{{"files", pages}}.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace canhil::dbc
