// Database -> DBC text.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The text of a database; parse() of it returns an equal database with another hash. Omits multiplexing,
/// further senders, environment variables and relation attributes, which canhil's contracts do not use.
std::string dbc_text(const Database& database);

}  // namespace canhil::dbc
