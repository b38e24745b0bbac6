// Generates C++ from a Database. The header has structs, pack(), unpack(), enumerations and the hash. The
// source, which is compiled once, has definitions that are rarely needed, and static checks.
#pragma once

#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::dbc {

/// The text of the header. The same database always gives the same text. Returns an error of one line if the
/// database breaks one of the rules on which the generated code relies (rules.hpp). For example, a message
/// with a data id must have the E2E fields, and a measurement must have enough resolution.
Result<std::string> generate_header(const Database& database, std::string_view name_space,
                                    std::string_view dbc_name);

/// The text of the source, for a database that generate_header() accepts. `header` is the path in the
/// #include of the source.
std::string generate_source(const Database& database, std::string_view name_space, std::string_view dbc_name,
                            std::string_view header);

}  // namespace canhil::dbc
