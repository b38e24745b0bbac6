// Converts a Database to JSON, for other tools and for the comparison with other DBC parsers.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The messages, signals, value tables, nodes and attributes, in the order of the DBC.
std::string to_json(const Database& database);
std::string to_json(const Message& message);

}  // namespace canhil::dbc
