// Writes findings in the Static Analysis Results Interchange Format (SARIF) 2.1.0, OASIS standard of 27 March
// 2020.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "dbc/lint/lint.hpp"

namespace canhil::dbc {
namespace {

using nlohmann::ordered_json;

/// Converts a path to a URI reference (RFC 3986) with percent-encoding. An absolute path becomes a file://
/// URI.
std::string uri_of(const std::string& path) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    if (plain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

ordered_json rules_json() {
  ordered_json rules = ordered_json::array();
  for (const RuleText& rule : rule_texts()) {
    rules.push_back({{"id", rule.id},
                     {"shortDescription", {{"text", rule.finding}}},
                     {"help", {{"text", rule.consequence}}},
                     {"defaultConfiguration", {{"level", name_of(rule.severity)}}}});
  }
  return rules;
}

ordered_json result_json(const Linted& linted, const Finding& finding) {
  const RuleText& rule = text_of(finding.rule);
  const ordered_json place = {
      {"artifactLocation", {{"uri", uri_of(linted.file)}}},
      {"region", {{"startLine", finding.at.line}, {"startColumn", finding.at.column}}}};
  return {{"ruleId", rule.id},
          {"ruleIndex", static_cast<std::size_t>(finding.rule)},
          {"level", name_of(rule.severity)},
          {"message", {{"text", fmt::format("{}; {}", finding.what, rule.consequence)}}},
          {"locations", ordered_json::array({{{"physicalLocation", place}}})}};
}

}  // namespace

std::string to_sarif(const std::vector<Linted>& files) {
  ordered_json results = ordered_json::array();
  for (const Linted& linted : files) {
    for (const Finding& finding : linted.findings) results.push_back(result_json(linted, finding));
  }
  const ordered_json run = {{"tool", {{"driver", {{"name", "hil-bench dbc lint"}, {"rules", rules_json()}}}}},
                            {"columnKind", "unicodeCodePoints"},
                            {"results", results}};
  const ordered_json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                            {"version", "2.1.0"},
                            {"runs", ordered_json::array({run})}};
  return log.dump(2) + "\n";
}

}  // namespace canhil::dbc
