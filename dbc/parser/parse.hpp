// Reads a DBC file. Strict: what it does not understand or cannot be right is an error, never a guess.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// DBC text (UTF-8 or Windows-1252, any line ends) as a Database.
/// Error: one line `file_name:line:column: what, expected ...`.
Result<Database> parse(std::string_view text, std::string_view file_name);

/// parse() of a file's content. Error also if the file cannot be read, or is larger than 16 MiB.
Result<Database> read_file(const std::string& path);

/// FNV-1a, 64 bits, of the text without carriage returns: one contract, whatever the checkout's line ends.
std::uint64_t hash(std::string_view text);

/// A 64-bit hash folded into 24 bits by exclusive or of its pieces, for the frames that exchange it.
constexpr std::uint32_t fold24(std::uint64_t hash) {
  return static_cast<std::uint32_t>((hash ^ (hash >> 24U) ^ (hash >> 48U)) & 0xFF'FFFFU);
}

}  // namespace canhil::dbc
