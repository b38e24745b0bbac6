// The worst-case bus load that follows from the cycle times of a DBC.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Table of bit/s and bus load: one line for each sender, and the sum. Event-triggered and CAN FD messages
/// are counted separately; their load is not included.
std::string load_table(const Database& database);

}  // namespace canhil::dbc
