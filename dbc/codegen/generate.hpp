// Database -> one constexpr C++ header: structs with pack() and unpack(), enumerations, metadata, hash.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The header's text; deterministic. Error: one line, if the database breaks a rule that generated code
/// relies on (E2E fields where a data id is given, resolution of measurements).
Result<std::string> generate_header(const Database& database, std::string_view name_space,
                                    std::string_view dbc_name);

}  // namespace canhil::dbc
