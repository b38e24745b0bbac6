#include "dbc/lint/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "dbc/parser/parse.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::dbc {
namespace {

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string finding_line(const Linted& linted, const Finding& finding) {
  const RuleText& rule = text_of(finding.rule);
  return fmt::format("{}:{}:{}: {} {}: {}; {}", linted.file, finding.at.line, finding.at.column,
                     name_of(rule.severity), rule.id, finding.what, rule.consequence);
}

std::string file_line(const Linted& linted) {
  std::string line = linted.file + ": ";
  line += linted.loads
              ? fmt::format("{}, {}", counted(linted.messages, "message"), counted(linted.signals, "signal"))
              : "refused";
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    if (const std::size_t n = count(linted, severity); n > 0) line += ", " + counted(n, name_of(severity));
  }
  return line;
}

}  // namespace

Result<Linted> lint(const std::string& file, const std::string& encoding) {
  auto inspection = inspect_file(file, encoding);
  if (!inspection) return tl::unexpected(inspection.error());
  Linted linted{file, std::move(inspection->findings), inspection->database.has_value()};
  std::ranges::stable_sort(linted.findings, {},
                           [](const Finding& f) { return std::tuple(f.at.line, f.at.column); });
  if (!linted.loads) return linted;
  linted.messages = inspection->database->messages.size();
  for (const Message& message : inspection->database->messages) linted.signals += message.signals.size();
  return linted;
}

std::size_t count(const Linted& linted, Severity severity) {
  const auto matches = std::ranges::count(linted.findings, severity,
                                          [](const Finding& f) { return text_of(f.rule).severity; });
  return static_cast<std::size_t>(matches);
}

std::string to_text(const std::vector<Linted>& files) {
  std::string text;
  for (const Linted& linted : files) {
    for (const Finding& finding : linted.findings) text += one_line(finding_line(linted, finding)) + "\n";
    text += one_line(file_line(linted)) + "\n";
  }
  return text;
}

std::string rule_table() {
  std::string table = "| rule | | what is found | what follows |\n|---|---|---|---|\n";
  for (const RuleText& rule : rule_texts()) {
    table += fmt::format("| `{}` | {} | {} | {} |\n", rule.id, name_of(rule.severity), rule.finding,
                         rule.consequence);
  }
  return table;
}

}  // namespace canhil::dbc
