// Reads a DBC file. One reader reports all that is odd about a text as findings (finding.hpp); the strict
// functions, for the contract that code is generated from, take no warning, the lenient ones no error.
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

struct Inspection {
  std::optional<Database> database;  ///< none: there is an error among the findings
  std::vector<Finding> findings;     ///< in the order in which they were found
};

/// All that a DBC text says and all that is odd about it.
Inspection inspect(std::string_view text);

/// inspect() of a file's content. Error if the file cannot be read, or is larger than 16 MiB.
Result<Inspection> inspect_file(const std::string& path);

/// The database of an inspection, or its first error as one line `file_name:line:column: what, expected ...`.
Result<Database> usable(Inspection inspection, std::string_view file_name);

/// Strict: DBC text (UTF-8 or Windows-1252, any line ends) as a Database.
/// Error: one line `file_name:line:column: what, expected ...`.
Result<Database> parse(std::string_view text, std::string_view file_name);

/// Lenient, usable(inspect(text), file_name): the same for DBC files of others. What is odd and harmless is
/// taken as the rules say.
Result<Database> parse_leniently(std::string_view text, std::string_view file_name);

/// parse() of a file's content. Error also if the file cannot be read, or is larger than 16 MiB.
Result<Database> read_file(const std::string& path);
Result<Database> read_file_leniently(const std::string& path);

/// FNV-1a, 64 bits, of the text without carriage returns: one contract, whatever the checkout's line ends.
std::uint64_t hash(std::string_view text);

/// A 64-bit hash folded into 24 bits by exclusive or of its pieces, for the frames that exchange it.
constexpr std::uint32_t fold24(std::uint64_t hash) {
  return static_cast<std::uint32_t>((hash ^ (hash >> 24U) ^ (hash >> 48U)) & 0xFF'FFFFU);
}

}  // namespace canhil::dbc
