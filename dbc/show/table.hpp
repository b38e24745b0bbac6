// Columns of text. Internal to show.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

using Row = std::vector<std::string>;

/// Rows of equally many cells, each column as wide as its widest cell, two blanks between columns. What would
/// break a line or steer a terminal becomes '?'.
std::string aligned(std::vector<Row> rows);

/// "0x123" of 11 bits, "0x00000123" of 29 bits, as candump writes them.
std::string id_text(const Message& message);

/// "10 ms"; "-": no cycle time.
std::string cycle_text(const Message& message);

/// The sender, and further ones; "-": nobody.
std::string sender_text(const Message& message);

}  // namespace canhil::dbc
