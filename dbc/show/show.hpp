// The content of a DBC file as text.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// A line for each message with its id, name, size, cycle time, sender and the names of its signals.
std::string message_table(const Database& database);

/// A page about one message: a matrix of its bytes and bits, and a line for each signal.
std::string message_page(const Message& message);

/// The message with this name or id. An id is decimal, or hexadecimal after 0x. If a standard and an extended
/// message have the same id, eight hexadecimal digits select the extended message. An error is one line.
Result<const Message*> named_message(const Database& database, const std::string& name);

}  // namespace canhil::dbc
