// Reads a DBC file. inspect() returns a finding (finding.hpp) for each place in the text that violates a
// rule. The strict functions are for the contract from which code is generated; they reject a file with
// warnings or errors. The lenient functions reject only a file with errors.
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
  std::optional<Database> database;  ///< nullopt: one of the findings is an error
  std::vector<Finding> findings;     ///< in the order in which they were found
};

/// Reads a DBC text. Returns the database, and all findings about the text. With an empty `encoding`, the
/// text is read as UTF-8 (or UTF-16 with a byte order mark), and as Windows-1252 if it is not UTF-8;
/// otherwise `encoding` must be a name that iconv knows, such as "shift_jis".
Inspection inspect(std::string_view text, const std::string& encoding = {});

/// Calls inspect() with the content of a file. Returns an error if the file cannot be read or is larger than
/// 16 MiB, or if iconv does not know the encoding.
Result<Inspection> inspect_file(const std::string& path, const std::string& encoding = {});

/// The database of an inspection. If the inspection found errors, returns the first of them as one line
/// `file_name:line:column: what, expected ...`.
Result<Database> usable(Inspection inspection, std::string_view file_name);

/// The strict reader: converts a DBC text (UTF-8 or Windows-1252, any line ends) to a Database. An error is
/// one line, `file_name:line:column: what, expected ...`.
Result<Database> parse(std::string_view text, std::string_view file_name);

/// The lenient reader, for DBC files of other makers: usable(inspect(text), file_name). Warnings have the
/// consequences that the rules state.
Result<Database> parse_leniently(std::string_view text, std::string_view file_name);

/// Calls parse() with the content of a file. Returns an error also if the file cannot be read, or is larger
/// than 16 MiB.
Result<Database> read_file(const std::string& path);
/// Calls parse_leniently() with the content of a file. Returns an error also if the file cannot be read, or
/// is larger than 16 MiB, or if iconv does not know the encoding (see inspect()).
Result<Database> read_file_leniently(const std::string& path, const std::string& encoding = {});

/// The 64-bit FNV-1a hash of the text without its carriage returns. So the hash does not depend on the line
/// ends that a git checkout uses.
std::uint64_t hash(std::string_view text);

/// Shortens a 64-bit hash to 24 bits: splits the hash into parts of 24, 24 and 16 bits and combines these
/// parts by XOR. Frames carry the result.
constexpr std::uint32_t fold24(std::uint64_t hash) {
  return static_cast<std::uint32_t>((hash ^ (hash >> 24U) ^ (hash >> 48U)) & 0xFF'FFFFU);
}

}  // namespace canhil::dbc
