// Rules that canhil's contract must keep in addition to the DBC format: protection of messages, and
// resolution of signals relative to sensor noise.
#pragma once

#include <optional>
#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

struct Breach {
  Position at;
  std::string what;  ///< one line: what, expected ...
};

/// The first breach, or none.
std::optional<Breach> find_breach(const Database& database);

/// A table row for every measurement: signal, LSB, sensor sigma, (LSB / sqrt 12) / sigma, whether the
/// rounding remainder is carried to the next sample, verdict.
std::string quantisation_table(const Database& database);

}  // namespace canhil::dbc
