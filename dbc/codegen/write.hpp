// Converts a Database to the text of a DBC file.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The text of a database. If the text is parsed, the resulting database equals `database` in everything
/// except the hash. Multiplexing, further senders, environment variables and relation attributes are omitted,
/// because canhil's contracts do not use them.
std::string dbc_text(const Database& database);

}  // namespace canhil::dbc
