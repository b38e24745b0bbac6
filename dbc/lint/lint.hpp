// Findings about DBC files, in the order of their lines, and three output formats.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

struct Linted {
  std::string file;               ///< the path as the user gave it
  std::vector<Finding> findings;  ///< by line and column
  bool loads = false;  ///< the lenient reader accepts the file; only then are the two counts below set
  std::size_t messages = 0;
  std::size_t signals = 0;
};

/// Error if the file cannot be read.
Result<Linted> lint(const std::string& file);

/// The number of findings of this severity.
std::size_t count(const Linted& linted, Severity severity);

/// One line for each finding, "file:line:column: severity rule: what; consequence", and one for each file.
std::string to_text(const std::vector<Linted>& files);
std::string to_json(const std::vector<Linted>& files);
/// SARIF 2.1.0 (OASIS), for code-review systems.
std::string to_sarif(const std::vector<Linted>& files);

/// The rules as a table in Markdown, for docs/dbc.md.
std::string rule_table();

}  // namespace canhil::dbc
