// The contract as tables for targets that are not written in C++: a C99 header and a Python module.
//
// A message that belongs to no sample group is a group of its own here, so that who uses the tables knows
// groups alone.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// A C99 header: the value tables as enumerations, an index for each group and for each value of a group,
/// and, where CANHIL_TABLES is defined, the layout of messages and signals as constant arrays.
/// Error: one line `dbc_name:line:column: ...` for a message that is not a classic one of at most eight
/// protected bytes with an 11-bit id, or for a signal that is big-endian, multiplexed or a 64-bit float, or
/// has the name of another signal of its group.
Result<std::string> c_header(const Database& database, std::string_view dbc_name);

/// A Python module with the same: VALUE_TABLES, GROUPS, ANSWERS, CYCLE_MS, DBC_HASH24.
/// Error: as c_header().
Result<std::string> python_module(const Database& database, std::string_view dbc_name);

}  // namespace canhil::dbc
