// The contract as tables for targets that are not written in C++: a C99 header and a Python module.
//
// A message without a sample group is a group of one message here, so that users of the tables handle groups
// only.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// A C99 header: the value tables as enumerations, an index for each group and for each value of a group,
/// and, where CANHIL_TABLES is defined, the layout of messages and signals as constant arrays.
/// Error: one line `dbc_name:line:column: ...`. Each message must be a classic one with at most eight
/// protected bytes and an 11-bit id. Each signal must be little-endian, not multiplexed, not a 64-bit float,
/// and have a name that is unique in its group.
Result<std::string> c_header(const Database& database, std::string_view dbc_name);

/// A Python module with the contract as VALUE_TABLES, GROUPS, ANSWERS, CYCLE_MS, FROM_TARGET and DBC_HASH24.
/// Error: as c_header().
Result<std::string> python_module(const Database& database, std::string_view dbc_name);

}  // namespace canhil::dbc
