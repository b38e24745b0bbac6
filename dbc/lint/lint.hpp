// Collects the findings about DBC files, sorted by line, and prints them in three formats.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

struct Linted {
  std::string file;               ///< the path as the user gave it
  std::vector<Finding> findings;  ///< sorted by line and column
  /// True if the lenient reader accepts the file. Otherwise `messages` and `signals` are 0.
  bool loads = false;
  std::size_t messages = 0;
  std::size_t signals = 0;
};

/// Inspects a DBC file. Returns an error if the file cannot be read.
Result<Linted> lint(const std::string& file, const std::string& encoding = {});

/// The number of findings that have this severity.
std::size_t count(const Linted& linted, Severity severity);

/// One line for each finding, "file:line:column: severity rule: what; consequence", and one line for each
/// file.
std::string to_text(const std::vector<Linted>& files);
std::string to_json(const std::vector<Linted>& files);
/// The findings in the format SARIF 2.1.0 (OASIS), which code-review systems read.
std::string to_sarif(const std::vector<Linted>& files);

/// The rules as a table in Markdown. docs/dbc.md contains this table.
std::string rule_table();

}  // namespace canhil::dbc
