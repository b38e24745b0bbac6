// Decodes packets of captures. Link types: SocketCAN (LINKTYPE_CAN_SOCKETCAN, 227), and the two of a capture
// on all interfaces (LINKTYPE_LINUX_SLL, 113; LINKTYPE_LINUX_SLL2, 276), in which another header precedes a
// frame of SocketCAN. A frame of SocketCAN has a header of eight bytes, then the data. The header has the id
// with SocketCAN's flags (big-endian), the length, the FD flags, and two zero bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "dbc/logs/formats.hpp"

namespace canhil::logs {

/// The link types whose packets can be frames.
enum LinkType : std::uint16_t { linux_sll = 113, socketcan = 227, linux_sll2 = 276 };

/// True for one of these link types.
constexpr bool is_read(std::uint16_t link) {
  return link == linux_sll || link == socketcan || link == linux_sll2;
}

/// The size of the header of a frame of SocketCAN, in bytes, and its flags.
inline constexpr std::size_t socketcan_header_size = 8;
inline constexpr std::uint32_t socketcan_extended = 0x8000'0000, socketcan_remote = 0x4000'0000,
                               socketcan_error = 0x2000'0000;
inline constexpr std::uint8_t socketcan_brs = 1, socketcan_esi = 2, socketcan_fd = 4, socketcan_xl = 0x80;

/// The frame in a packet. Sets the frame; for SLL and SLL2 also the direction, and for SLL2 the name of the
/// interface, "if" and its index. The error states what is wrong with the packet.
Result<Parsed> frame_of_packet(std::uint16_t link, std::span<const std::uint8_t> packet);

}  // namespace canhil::logs
