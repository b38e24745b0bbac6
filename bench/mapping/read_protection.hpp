// [[protection]] of a mapping: docs/protection.md has the keys.
#pragma once

#include <optional>

#include "dbc/parser/database.hpp"
#include "dbc/protection/protection.hpp"

namespace canhil::scenario {
class Section;
}

namespace canhil::mapping {

/// What one of the messages of the table is protected by; none: that is wrong, which the section then says.
std::optional<protection::Protection> read_protection(scenario::Section& section,
                                                      const dbc::Message& message);

}  // namespace canhil::mapping
