// The worst-case load that the cycle times of a DBC put on its bus.
#pragma once

#include <cstdint>
#include <string>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// Bits of a classic frame on the wire at worst, with stuff bits and the 3 bits between frames.
/// 8 s + 47 + floor((34 + 8 s - 1) / 4) for 11-bit ids, 67 and 54 for 29-bit ids (Davis, Burns, Bril, Lukkien
/// 2007, eq. 1).
constexpr std::int64_t worst_case_bits(unsigned size, bool extended) {
  const std::int64_t data = 8 * static_cast<std::int64_t>(size);
  return extended ? data + 67 + (54 + data - 1) / 4 : data + 47 + (34 + data - 1) / 4;
}

/// Table of bit/s and share of the bus, a line each sender and the sum. Messages sent on events, and CAN FD,
/// are counted apart: their load is not in it.
std::string load_table(const Database& database);

}  // namespace canhil::dbc
