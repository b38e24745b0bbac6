// Reads [[protection]] of a mapping: docs/protection.md has the keys.
#pragma once

#include <optional>

#include "dbc/parser/database.hpp"
#include "dbc/protection/protection.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::mapping {

/// The protection of `message`, which is one of the messages that the table names. None: the table is
/// invalid, and the section contains the error.
std::optional<protection::Protection> read_protection(scenario::Section& section,
                                                      const dbc::Message& message);

}  // namespace canhil::mapping
