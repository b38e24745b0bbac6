// Formats tables of text. This header is internal to dbc/show.
#pragma once

#include <string>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

using Row = std::vector<std::string>;

/// Formats a table; all rows must have the same number of cells. Each column is as wide as its widest cell,
/// and two blanks separate the columns. one_line() escapes the cells.
std::string aligned(std::vector<Row> rows);

/// The id as text: "0x123" for 11 bits, "0x00000123" for 29 bits. The number of digits is that of candump.
std::string id_text(const Message& message);

/// The cycle time as text, such as "10 ms"; "-": the message has no cycle time.
std::string cycle_text(const Message& message);

/// The names of all senders; "-": the message has no sender.
std::string sender_text(const Message& message);

}  // namespace canhil::dbc
