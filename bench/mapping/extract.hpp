// A recording of somebody else's bus, as a CSV file that a node can send again (docs/recorded-data.md).
#pragma once

#include <string>

#include "bench/mapping/mapping.hpp"

namespace canhil::mapping {

struct Extracted {
  std::string csv;
  std::size_t rows = 0;
  std::size_t incomplete =
      0;  ///< groups of which a message was missing, or protected wrongly: they are left out
};

/// What was sent as a play in a candump log: a row a group, with the stamp of its last frame as t_s. `play`:
/// the name of its last message. Error: one line; the mapping has no such play, or the log none of it.
Result<Extracted> extract(const Mapping& mapping, std::string_view play, const std::string& log);

}  // namespace canhil::mapping
