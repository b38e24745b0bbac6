// The worst-case load that the cycle times of a DBC put on its bus.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Table of bit/s and share of the bus, a line each sender and the sum. Messages sent on events, and CAN FD,
/// are counted apart: their load is not in it.
std::string load_table(const Database& database);

}  // namespace canhil::dbc
