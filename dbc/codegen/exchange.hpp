// Which messages a run exchanges, and the hash that target and bench compare.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The hash of the messages that a run with one estimator exchanges.
struct Exchange {
  std::string estimator;  ///< empty: the messages that every run exchanges
  std::uint32_t hash24 = 0;
};

/// The exchange without an estimator, then those of the estimators that the attributes `Estimators` of the
/// messages name, by name. A message without this attribute belongs to every exchange.
///
/// The hash is the FNV-1a, folded into 24 bits, of what both sides must agree about: name, id, size, data id,
/// cycle time, sample group and answered groups of each message, and name, place, type, scale, offset and
/// multiplexing of each signal. The named values of a signal belong to it only in a message of an estimator:
/// the messages of every run name estimators and parameters, and a new one must not exclude old targets.
std::vector<Exchange> exchanges(const Database& database);

}  // namespace canhil::dbc
