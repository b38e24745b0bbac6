// Reads and writes the bits of a message that are at a Place.
#pragma once

#include <cstdint>
#include <span>

#include "dbc/protection/settings.hpp"
#include "dbc/wire/bits.hpp"

namespace canhil::protection {

/// Calls visit(byte, mask, index) for each bit of a field. `byte` and `mask` give the position of the bit in
/// the message. `index` is the number of the bit in the field; the least significant bit of the field has
/// number 0.
template <class Visit>
void for_each_bit(const Place& place, Visit visit) {
  for (unsigned i = 0; i < place.length; ++i) {
    const unsigned position = wire::bit_position(place.start_bit, i, place.big_endian);
    visit(position / 8, static_cast<std::uint8_t>(1U << (position % 8)),
          place.big_endian ? place.length - 1 - i : i);
  }
}

/// The bits of the field at `place`, right-aligned. The whole field must be inside `data`.
inline std::uint64_t read(const Place& place, std::span<const std::uint8_t> data) {
  std::uint64_t value = 0;
  for_each_bit(place, [&](unsigned byte, std::uint8_t bit, unsigned index) {
    if ((data[byte] & bit) != 0) value |= std::uint64_t{1} << index;
  });
  return value;
}

/// Writes the lowest bits of `value` into the field at `place`, and does not change other bits. The whole
/// field must be inside `data`.
inline void write(const Place& place, std::uint64_t value, std::span<std::uint8_t> data) {
  for_each_bit(place, [&](unsigned byte, std::uint8_t bit, unsigned index) {
    const bool set = ((value >> index) & 1U) != 0;
    data[byte] = static_cast<std::uint8_t>(set ? data[byte] | bit : data[byte] & ~bit);
  });
}

}  // namespace canhil::protection
