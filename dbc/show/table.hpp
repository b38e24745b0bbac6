// Columns of text. Internal to show.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

using Row = std::vector<std::string>;

/// Formats rows with equal numbers of cells: each column as wide as its widest cell, two blanks between
/// columns. Control characters become '?'.
std::string aligned(std::vector<Row> rows);

/// "0x123" for 11 bits, "0x00000123" for 29 bits, like candump.
std::string id_text(const Message& message);

/// "10 ms"; "-": no cycle time.
std::string cycle_text(const Message& message);

/// All senders; "-": none.
std::string sender_text(const Message& message);

}  // namespace canhil::dbc
