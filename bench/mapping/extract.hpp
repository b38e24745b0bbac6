// Converts a recording of another bus to a CSV file that a node can replay (docs/recorded-data.md).
#pragma once

#include <string>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

struct Extracted {
  std::string csv;
  std::size_t rows = 0;
  std::size_t incomplete = 0;  ///< groups left out: a message is missing or its protection fails
};

/// The transmissions of a play in a candump log: one row for each group, with the stamp of its last frame as
/// t_s. `play`: the name of its last message. Error: one line; the mapping has no such play, or the log does
/// not contain it.
Result<Extracted> extract(const Mapping& mapping, std::string_view play, const std::string& log);

}  // namespace canhil::mapping
