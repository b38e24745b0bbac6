// Rules about the frames that a bus can carry (ISO 11898-1:2015, 8.4.2).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// The largest 11-bit id.
constexpr std::uint32_t max_standard_id = 0x7FF;
/// The largest 29-bit id.
constexpr std::uint32_t max_extended_id = 0x1FFF'FFFF;

/// The data size for each data length code (DLC) of CAN FD. Classic CAN uses only the first nine.
inline constexpr std::array<std::uint8_t, 16> size_of_dlc{0, 1,  2,  3,  4,  5,  6,  7,
                                                          8, 12, 16, 20, 24, 32, 48, 64};

/// The data length code of a size; 16: the size has no data length code.
constexpr std::size_t dlc_of(std::uint8_t size) {
  return static_cast<std::size_t>(std::ranges::find(size_of_dlc, size) - size_of_dlc.begin());
}

/// True if the size has a data length code: 0 to 8, and for FD also 12, 16, 20, 24, 32, 48 and 64.
constexpr bool size_has_dlc(std::uint8_t size, bool fd) { return dlc_of(size) < (fd ? 16 : 9); }

/// True if the bus can carry the frame. `fd_bus` is true for a CAN FD bus, false for a classic bus. Error
/// frames are classic; their id may contain any error class bits.
constexpr bool can_carry(const Frame& frame, bool fd_bus) {
  if (frame.fd && (!fd_bus || frame.error)) return false;
  if ((frame.brs || frame.esi) && !frame.fd) return false;
  const bool wide_id = frame.extended || frame.error;
  return frame.id <= (wide_id ? max_extended_id : max_standard_id) && size_has_dlc(frame.size, frame.fd);
}

}  // namespace canhil
