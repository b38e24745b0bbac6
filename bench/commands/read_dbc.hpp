// Reads a DBC file for a command.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bench/commands/exit_code.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::commands {

/// The help of the option --encoding of commands that read a DBC.
inline constexpr const char* encoding_help =
    "encoding of the DBC's text, as iconv names it (default: UTF-8, else Windows-1252)";

/// Reads a DBC leniently. Prints the number of warnings and the first one, because a command that only uses
/// the DBC does not list them. Error, one line: the file cannot be read, is not a DBC, or iconv does not know
/// the encoding.
inline Result<dbc::Database> read_dbc(const std::string& file, const std::string& encoding = {}) {
  auto inspection = dbc::inspect_file(file, encoding);
  if (!inspection) return tl::unexpected(inspection.error());
  const auto is_warning = [](const dbc::Finding& finding) {
    return dbc::text_of(finding.rule).severity == dbc::Severity::warning;
  };
  const auto warnings = std::ranges::count_if(inspection->findings, is_warning);
  if (inspection->database && warnings > 0) {
    const dbc::Finding& first = *std::ranges::find_if(inspection->findings, is_warning);
    say(fmt::format("{}: {} warning{}, which 'hil-bench dbc lint' lists; the first: line {}: {}", file,
                    warnings, warnings == 1 ? "" : "s", first.at.line, first.what));
  }
  return dbc::usable(std::move(*inspection), file);
}

}  // namespace canhil::commands
