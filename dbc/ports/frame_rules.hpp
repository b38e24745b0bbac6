// What a bus can carry (ISO 11898-1:2015, 8.4.2).
#pragma once

#include <cstdint>

#include "dbc/wire/frame.hpp"

namespace canhil {

constexpr std::uint32_t max_standard_id = 0x7FF;
constexpr std::uint32_t max_extended_id = 0x1FFF'FFFF;

/// True where a data length code stands for this size: 0-8, and in FD 12, 16, 20, 24, 32, 48, 64.
constexpr bool size_has_dlc(std::uint8_t size, bool fd) {
  if (size <= 8) return true;
  return fd && ((size <= 24 && size % 4 == 0) || size == 32 || size == 48 || size == 64);
}

/// True if a bus, classic or FD, can carry the frame. Error frames have classic form and any class bits as
/// id.
constexpr bool can_carry(const Frame& frame, bool fd_bus) {
  if (frame.fd && (!fd_bus || frame.error)) return false;
  if (frame.brs && !frame.fd) return false;
  const bool wide_id = frame.extended || frame.error;
  return frame.id <= (wide_id ? max_extended_id : max_standard_id) && size_has_dlc(frame.size, frame.fd);
}

}  // namespace canhil
