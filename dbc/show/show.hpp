// The content of a DBC file as text.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// A line for each message: id, name, size, cycle time, sender, names of its signals.
std::string message_table(const Database& database);

/// One message: its bits as a matrix of bytes and bits, and a line for each signal.
std::string message_page(const Message& message);

/// The message with this name, or with this id: decimal, or hexadecimal after 0x. If a standard and an
/// extended message have the same id, eight hexadecimal digits select the extended one. Error: one line.
Result<const Message*> named_message(const Database& database, const std::string& name);

}  // namespace canhil::dbc
