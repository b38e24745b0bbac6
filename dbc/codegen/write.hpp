// Database -> DBC text.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The text of a database; parse() gives the same database again, but for its hash. Multiplexing, environment
/// variables and relation attributes are left out: canhil's contracts have none.
std::string dbc_text(const Database& database);

}  // namespace canhil::dbc
