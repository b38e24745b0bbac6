// The contract as tables for targets that are not written in C++: a C99 header and a Python module.
//
// In these tables, a message without a sample group forms a group of one message. So users of the tables only
// have to handle groups.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// Generates a C99 header. It has the value tables as enumerations, and an index for each group and for each
/// value of a group. If CANHIL_TABLES is defined, it also has the layout of messages and signals as constant
/// arrays. Returns an error of one line, `dbc_name:line:column: ...`, if a message or signal does not meet
/// these conditions: each message is classic and protected, and has at most eight bytes and an 11-bit id;
/// each signal is little-endian, is neither multiplexed nor a 64-bit float, and has a name that is unique in
/// its group.
Result<std::string> c_header(const Database& database, std::string_view dbc_name);

/// Generates a Python module that describes the contract with VALUE_TABLES, GROUPS, ANSWERS, CYCLE_MS,
/// FROM_TARGET and HASH24. Returns an error in the same cases as c_header().
Result<std::string> python_module(const Database& database, std::string_view dbc_name);

}  // namespace canhil::dbc
