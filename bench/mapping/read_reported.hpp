// Reads which quantities the signals of a target's message carry.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "bench/mapping/mapping.hpp"
#include "bench/mapping/signal_units.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::mapping {

/// What the rest of the mapping says about quantities and signals.
struct Known {
  std::deque<ReferenceQuantity>& own;  ///< quantities that the mapping defines; commands are added
  const SignalUnits& units;
};

/// Reads the table `signals` of a [[hear]]: a quantity, its sigma, the correlation of two quantities, or a
/// part of the quaternion of the attitude. `invalid`: the table of the raw values that mean "no value".
void read_reported(scenario::Section& signals, std::optional<scenario::Section>& invalid, const Known& known,
                   Hear& hear);

/// Reports an error about a key if raw bits are more than the signal has.
void expect_bits(scenario::Section& section, const std::string& key, const dbc::Signal& signal,
                 std::uint64_t raw);

}  // namespace canhil::mapping
