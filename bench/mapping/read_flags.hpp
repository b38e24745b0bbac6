// Reads the flags that a message of a target carries.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::mapping {

/// Reads the table [hear.flags] of the message `of`. Each key is a signal. Its value is the name of a flag
/// that is set if the signal is not 0, or a table: NAME = a raw value, the name of a raw value, or { bit = N
/// }. `signs`: the names of the flags that are signs of trouble.
std::vector<ReportedFlag> read_flags(scenario::Section& section, const dbc::Message& of,
                                     std::span<const std::string> signs);

}  // namespace canhil::mapping
