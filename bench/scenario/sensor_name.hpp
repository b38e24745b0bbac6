// A sensor with a name of its own ([[sensor]]).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bench/scenario/contract.hpp"
#include "bench/scenario/node.hpp"

namespace canhil::scenario {

/// Whether a text is a name of the user's own: of a-z, 0-9 and _.
bool is_name(std::string_view text);
/// What is expected of the name of a sensor.
inline constexpr std::string_view own_name = "a name of its own of a-z, 0-9 and _, such as imu_b";
/// Why a sensor may not have this name; empty: it may.
std::string why_no_name(std::string_view name, std::span<const std::string> kinds);

/// Reads the keys `name` and `kind` and returns the table with this name. `others`: the sensors with other
/// names. Null: the section has an error.
const NodeTable* read_sensor_name(Section& section, const DbcVocabulary& contract,
                                  std::span<const NodeSettings> others);

}  // namespace canhil::scenario
