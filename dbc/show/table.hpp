// Columns of text. Internal to show.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

using Row = std::vector<std::string>;

/// Rows of equally many cells, each column as wide as its widest cell, two blanks between columns.
std::string aligned(const std::vector<Row>& rows);

/// "0x123" of 11 bits, "0x00000123x" of 29 bits.
std::string id_text(const Message& message);

/// "10 ms"; "-": no cycle time.
std::string cycle_text(const Message& message);

/// The sender, and further ones; "-": nobody.
std::string sender_text(const Message& message);

}  // namespace canhil::dbc
