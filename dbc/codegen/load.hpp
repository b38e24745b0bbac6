// The worst-case bus load that follows from the cycle times of a DBC.
#pragma once

#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// A table with one line for each sender and one line for the sum of all senders. Its columns include the
/// bit/s and the bus load. The load includes only cyclic classic messages. A separate column has the number
/// of all other messages (event-triggered or CAN FD).
std::string load_table(const Database& database);

}  // namespace canhil::dbc
