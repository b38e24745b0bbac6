// Database -> C++: a header with structs, pack(), unpack(), enumerations and the hash, and a source with
// rarely needed definitions and static checks, compiled once.
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

/// The source's text, for a database that generate_header() accepts; `header` is the path that the source
/// includes.
std::string generate_source(const Database& database, std::string_view name_space, std::string_view dbc_name,
                            std::string_view header);

}  // namespace canhil::dbc
