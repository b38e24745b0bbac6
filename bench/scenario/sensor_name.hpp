// A sensor with a name of its own ([[sensor]]).
#pragma once

#include <span>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/node.hpp"

namespace canhil::scenario {

/// Reads the keys `name` and `kind` and returns the table with this name. `others`: the sensors with other
/// names. Null: the section has an error.
const NodeTable* read_sensor_name(Section& section, const DbcVocabulary& contract,
                                  std::span<const NodeSettings> others);

}  // namespace canhil::scenario
