// The fields of a CAN id in SAE J1939-21. An id of 29 bits consists of the priority (3 bits), the extended
// data page and the data page (1 bit each), the PDU format, the PDU specific field and the source address
// (8 bits each).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace canhil::wire {

/// PDU formats below this value are PDU1: the PDU specific field is the destination address, and not part of
/// the number of the parameter group.
inline constexpr std::uint32_t first_pdu2_format = 240;

/// The address of the sender.
constexpr std::uint8_t j1939_source(std::uint32_t id) { return static_cast<std::uint8_t>(id & 0xFFU); }

/// The number of the parameter group (PGN), 18 bits.
constexpr std::uint32_t j1939_group(std::uint32_t id) {
  const std::uint32_t number = (id >> 8U) & 0x3'FFFFU;
  return ((number >> 8U) & 0xFFU) < first_pdu2_format ? number & 0x3'FF00U : number;
}

/// Whether NMEA 2000 sends messages of this id and size [byte] as fast packets, in several frames
/// (dbc/transport/fast_packet.hpp): the parameter group is of data page 1, from 126208 on.
constexpr bool is_fast_packet(std::uint32_t id, bool extended, std::size_t size) {
  constexpr std::uint32_t first_group = 126'208, last_group = 131'071;
  constexpr std::size_t fewest_bytes = 9, most_bytes = 223;
  const std::uint32_t group = j1939_group(id);
  return extended && size >= fewest_bytes && size <= most_bytes && group >= first_group &&
         group <= last_group;
}

/// The address of the receiver; nullopt: the frame is for all nodes, because its PDU format is PDU2.
constexpr std::optional<std::uint8_t> j1939_destination(std::uint32_t id) {
  if (((id >> 16U) & 0xFFU) >= first_pdu2_format) return std::nullopt;
  return static_cast<std::uint8_t>((id >> 8U) & 0xFFU);
}

}  // namespace canhil::wire
