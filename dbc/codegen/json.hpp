// A Database as JSON, for other tools and for comparison with other DBC parsers.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Messages, signals, value tables, nodes, attributes; in the order of the DBC.
std::string to_json(const Database& database);
std::string to_json(const Message& message);

}  // namespace canhil::dbc
