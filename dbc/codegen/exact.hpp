// The twin of a contract that rounds nothing: what a run costs less on it is the cost of the bus.
#pragma once

#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The same messages, ids, names, groups and types of members, with every scaled signal carried as a 64-bit
/// float in a CAN FD frame: signals one after another behind the E2E fields, floats from whole bytes on,
/// integers as wide as they were. Ranges stay, so both twins saturate alike and differ by rounding alone.
/// Messages without scaled signals stay as they are, and so twins can exchange their hashes, which differ.
/// Error: one line `dbc_name:line:column: ...` for a message that does not fit into 64 bytes.
Result<Database> exact(const Database& database, std::string_view dbc_name);

}  // namespace canhil::dbc
