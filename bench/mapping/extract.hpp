// Converts a recording of another bus to a CSV file that a node can replay (docs/recorded-data.md).
#pragma once

#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

struct Extracted {
  std::string csv;
  std::size_t rows = 0;
  std::size_t incomplete = 0;  ///< groups left out: a message is missing or its protection fails
  std::size_t invalid = 0;     ///< transmissions left out: a value is said to be invalid
};

/// Extracts the transmissions of a play from a log, with one row for each transmission. t_s is the
/// time stamp of the last frame of the transmission. `name`: the name of the play's last message. It is an
/// error if the mapping has no such play, or if the log does not contain the play; the error is one line of
/// text.
Result<Extracted> extract(const Mapping& mapping, std::string_view name, const std::string& log);

}  // namespace canhil::mapping
