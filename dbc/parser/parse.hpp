// Reads a DBC file. One reader reports all oddities of a text as findings (finding.hpp). The strict
// functions, for the contract from which code is generated, reject a file with warnings or errors; the
// lenient ones reject only errors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dbc/parser/database.hpp"
#include "dbc/parser/finding.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The result of inspect().
struct Inspection {
  std::optional<Database> database;  ///< none: one of the findings is an error
  std::vector<Finding> findings;     ///< in the order in which they were found
};

/// The database of a DBC text, and all findings about it.
Inspection inspect(std::string_view text);

/// inspect() of a file's content. Error if the file cannot be read, or is larger than 16 MiB.
Result<Inspection> inspect_file(const std::string& path);

/// The database of an inspection, or its first error as one line `file_name:line:column: what, expected ...`.
Result<Database> usable(Inspection inspection, std::string_view file_name);

/// Strict: DBC text (UTF-8 or Windows-1252, any line ends) as a Database.
/// Error: one line `file_name:line:column: what, expected ...`.
Result<Database> parse(std::string_view text, std::string_view file_name);

/// Lenient, for DBC files from elsewhere: usable(inspect(text), file_name). Harmless oddities have the
/// consequences that the rules give.
Result<Database> parse_leniently(std::string_view text, std::string_view file_name);

/// parse() of a file's content. Error also if the file cannot be read, or is larger than 16 MiB.
Result<Database> read_file(const std::string& path);
/// parse_leniently() of a file's content; errors like read_file().
Result<Database> read_file_leniently(const std::string& path);

/// FNV-1a, 64 bits, of the text without carriage returns, so that a checkout's line ends do not change it.
std::uint64_t hash(std::string_view text);

/// Folds a 64-bit hash into 24 bits by exclusive or of its parts, for the frames that carry it.
constexpr std::uint32_t fold24(std::uint64_t hash) {
  return static_cast<std::uint32_t>((hash ^ (hash >> 24U) ^ (hash >> 48U)) & 0xFF'FFFFU);
}

}  // namespace canhil::dbc
