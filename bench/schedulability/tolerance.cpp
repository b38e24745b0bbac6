#include "bench/schedulability/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace canhil::schedulability {
namespace {

using dbc::Rule;

bool touches_timing(const dbc::Finding& finding) {
  // After these findings, a message or its period is missing, or it is unknown what is missing.
  constexpr std::array lost{Rule::unfinished_string, Rule::unreadable_message, Rule::too_many_findings,
                            Rule::message_size,      Rule::impossible_id,      Rule::duplicate_id,
                            Rule::cycle_time};
  if (std::ranges::find(lost, finding.rule) != lost.end()) return true;
  // These findings do not change a value that the analysis reads.
  constexpr std::array harmless{Rule::unknown_message,  Rule::unknown_signal,    Rule::unknown_variable,
                                Rule::attribute_limits, Rule::missing_semicolon, Rule::attribute_range,
                                Rule::undeclared_node};
  if (!finding.in_attribute_section || std::ranges::find(harmless, finding.rule) != harmless.end())
    return false;
  constexpr std::array<std::string_view, 7> read{"",  // the section may be about any attribute
                                                 "GenMsgCycleTime",
                                                 "GenMsgDelayTime",
                                                 "GenMsgDeadline",
                                                 "GenMsgJitter",
                                                 "VFrameFormat",
                                                 "CANFD_BRS"};
  return std::ranges::find(read, finding.attribute) != read.end();
}

}  // namespace

Result<std::vector<Tolerated>> tolerated(const dbc::Inspection& inspection, const std::string& file) {
  std::map<Rule, Tolerated> by_rule;
  for (const dbc::Finding& finding : inspection.findings) {
    const dbc::Severity severity = text_of(finding.rule).severity;
    if (severity == dbc::Severity::note) continue;
    if (severity == dbc::Severity::error || touches_timing(finding)) {
      return failure(fmt::format("{}:{}:{}: {}", file, finding.at.line, finding.at.column, finding.what));
    }
    Tolerated& same = by_rule.try_emplace(finding.rule, Tolerated{finding.rule, 0, finding}).first->second;
    ++same.count;
  }
  std::vector<Tolerated> all;
  for (auto& [rule, one] : by_rule) all.push_back(std::move(one));
  return all;
}

}  // namespace canhil::schedulability
