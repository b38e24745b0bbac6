// A finding is a place in a DBC text that violates a rule. The table of rules states the consequence of each
// violation; docs/dbc.md contains this table.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// note: no information of the file is lost, and both readers accept the file. warning: the strict reader
/// rejects the file; the lenient reader accepts it, with the consequence that the rule states. error: both
/// readers reject the file.
enum class Severity : std::uint8_t { note, warning, error };

/// The rules. rule_texts() returns the texts of all rules.
enum class Rule : std::uint8_t {
  not_a_dbc,
  unfinished_string,
  unreadable_message,
  unreadable_signal,
  too_many_findings,
  windows_1252,
  text_encoding,
  independent_signals,
  unreadable_section,
  unreadable_entry,
  unknown_section,
  missing_semicolon,
  line_comment,
  unexpected_character,
  name_character,
  name_begins_with_digit,
  number_too_large,
  not_whole,
  undeclared_node,
  missing_node,
  duplicate_node,
  missing_extended_flag,
  impossible_id,
  duplicate_id,
  duplicate_message,
  message_size,
  fd_format_missing,
  fd_size,
  frame_format,
  cycle_time,
  data_id,
  duplicate_signal,
  signal_beyond_message,
  signal_length,
  overlap,
  scale_zero,
  minimum_above_maximum,
  unreachable_range,
  float_length,
  multiplexor_type,
  multiplexor_missing,
  second_multiplexor,
  multiplexor_value,
  multiplexing_circle,
  multiplexor_left_out,
  indicator_missing,
  empty_range,
  duplicate_multiplexing,
  unknown_message,
  unknown_signal,
  unknown_variable,
  duplicate_variable,
  duplicate_table,
  duplicate_value,
  duplicate_values,
  value_beyond_bits,
  values_of_float,
  undefined_attribute,
  duplicate_definition,
  attribute_owner,
  attribute_limits,
  attribute_range,
  attribute_label,
  duplicate_default,
  duplicate_attribute,
  long_symbol,
};

/// The text of a rule.
struct RuleText {
  Rule rule;
  std::string_view id;  ///< name of the rule, such as "undeclared-node"
  Severity severity;
  std::string_view finding;      ///< what violates the rule, without details of a file
  std::string_view consequence;  ///< what the lenient reader does
};

/// All rules, in the order of the enumeration.
std::span<const RuleText> rule_texts();
/// The text of one rule.
const RuleText& text_of(Rule rule);
/// The name of a severity: "note", "warning", "error".
std::string_view name_of(Severity severity);

/// A place where a text violates a rule.
struct Finding {
  Rule rule;
  Position at;
  std::string what;  ///< one line that states what was found and what was expected
  /// The attribute that the section (BA_ and the like) defines or assigns; empty: the finding is not in such
  /// a section, or its attribute could not be read.
  std::string attribute{};
  bool in_attribute_section = false;
};

/// Collects the findings about a text. Keeps the first 10,000 of them, and one that states that there are
/// more.
class Findings {
 public:
  /// Adds a finding.
  void add(Rule rule, Position at, std::string what);
  /// Adds a finding, except if there is already one with the same rule and name: an undeclared node may occur
  /// a thousand times in a text.
  void add_once(Rule rule, Position at, const std::string& name, std::string what);
  /// All findings until the next call are in a section about this attribute; nullopt: in another section.
  void set_attribute_section(std::optional<std::string> attribute) { attribute_ = std::move(attribute); }

  /// The findings so far.
  [[nodiscard]] const std::vector<Finding>& all() const { return all_; }
  /// Returns the findings and removes them from this object.
  [[nodiscard]] std::vector<Finding> take() { return std::move(all_); }

 private:
  std::optional<std::string> attribute_;
  std::vector<Finding> all_;
  std::set<std::pair<Rule, std::string>> named_;
};

}  // namespace canhil::dbc
