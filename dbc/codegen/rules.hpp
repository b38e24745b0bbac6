// The rules that canhil's contract must follow in addition to those of the DBC format. They are about the
// protection of messages, the answers, and the resolution of signals relative to the sensor noise.
#pragma once

#include <optional>
#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

struct Breach {
  Position at;
  std::string what;  ///< one line that states what is wrong and what is expected
};

/// The first breach of a rule; nullopt: the database follows all rules.
std::optional<Breach> find_breach(const Database& database);

/// A table with a row for every measurement. The columns are: signal; LSB; sensor sigma; ratio of the
/// rounding noise to the sensor noise, i.e. (LSB / sqrt 12) / sigma; whether the remainder of the rounding is
/// added to the next sample; verdict.
std::string quantisation_table(const Database& database);

}  // namespace canhil::dbc
