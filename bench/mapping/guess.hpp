// Guesses which quantity a signal of a foreign DBC carries, by its name, the name of its message, and its
// unit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "dbc/parser/database.hpp"

namespace canhil::mapping {

/// What a signal carries, as a mapping writes it: "imu.rate.z", "attitude.roll.sigma"; empty: its name and
/// its unit do not tell. The sign is unknown: the axes of a device are in no DBC.
std::string guess_played(const dbc::Message& message, const dbc::Signal& signal);
std::string guess_reported(const dbc::Message& message, const dbc::Signal& signal);

/// Whether the name of a signal is that of a counter or a checksum.
bool is_counter(const dbc::Signal& signal);
bool is_checksum(const dbc::Signal& signal);

}  // namespace canhil::mapping
