#include <fmt/format.h>

#include "dbc/logs/pcap.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::logs {
namespace {

using Packet = std::span<const std::uint8_t>;

std::uint32_t big_endian(Packet bytes) {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

// LINKTYPE_CAN_SOCKETCAN. `fd` is true if a header before it states that the frame is one of CAN FD.
Result<Parsed> of_socketcan(Packet packet, bool fd, LogEntry entry) {
  constexpr std::size_t header_size = socketcan_header_size;
  if (packet.size() < header_size)
    return failure(fmt::format("{} bytes, expected a header of {}", packet.size(), header_size));
  if ((packet[4] & socketcan_xl) != 0) return Parsed{.left_out = "frames of CAN XL"};
  constexpr std::size_t full_fd =
      socketcan_header_size + Frame::max_size;  // a kernel before 6.1 sets no FD flag
  fd = fd || packet.size() == full_fd;
  const std::uint32_t id = big_endian(packet.first(4));
  const std::size_t size = packet[4];
  Frame& frame = entry.frame;
  frame = {.id = id & max_extended_id,
           .extended = (id & socketcan_extended) != 0,
           .fd = fd || (packet[5] & socketcan_fd) != 0 || size > 8,
           .error = (id & socketcan_error) != 0};
  frame.brs = frame.fd && (packet[5] & socketcan_brs) != 0;
  frame.esi = frame.fd && (packet[5] & socketcan_esi) != 0;
  entry.remote = !frame.fd && !frame.error && (id & socketcan_remote) != 0;
  if (size > Frame::max_size || (!entry.remote && size > packet.size() - header_size))
    return failure(fmt::format("{} bytes of data, expected {}", packet.size() - header_size, size));
  frame.size = static_cast<std::uint8_t>(size);
  if (!can_carry(frame, true))
    return failure(fmt::format("id {:X} with {} bytes, expected a frame of CAN or CAN FD", frame.id, size));
  if (!entry.remote) std::ranges::copy(packet.subspan(header_size, size), frame.data.begin());
  return Parsed{.entry = std::move(entry)};
}

// The frame behind a header of SLL or SLL2, by the protocol that the header states.
Result<Parsed> of_protocol(std::uint32_t protocol, Packet rest, LogEntry entry) {
  constexpr std::uint32_t can = 0x0C, can_fd = 0x0D, can_xl = 0x0E;
  if (protocol == can_xl) return Parsed{.left_out = "frames of CAN XL"};
  if (protocol != can && protocol != can_fd) return Parsed{.left_out = "packets of other protocols than CAN"};
  return of_socketcan(rest, protocol == can_fd, std::move(entry));
}

constexpr std::uint32_t outgoing = 4;  // a packet that this machine has sent

}  // namespace

Result<Parsed> frame_of_packet(std::uint16_t link, Packet packet) {
  if (link == socketcan) return of_socketcan(packet, false, {});
  LogEntry entry;
  if (link == linux_sll) {  // packet type, hardware type, address length u16, address 8 bytes, protocol u16
    constexpr std::size_t header_size = 16;
    if (packet.size() < header_size)
      return failure(fmt::format("{} bytes, expected a header of {}", packet.size(), header_size));
    entry.transmitted = big_endian(packet.first(2)) == outgoing;
    return of_protocol(big_endian(packet.subspan(14, 2)), packet.subspan(header_size), std::move(entry));
  }
  if (link ==
      linux_sll2) {  // protocol, 0 u16, interface u32, hardware type u16, packet type, address length u8, ...
    constexpr std::size_t header_size = 20;
    if (packet.size() < header_size)
      return failure(fmt::format("{} bytes, expected a header of {}", packet.size(), header_size));
    entry.interface = fmt::format("if{}", big_endian(packet.subspan(4, 4)));
    entry.transmitted = packet[10] == outgoing;
    return of_protocol(big_endian(packet.first(2)), packet.subspan(header_size), std::move(entry));
  }
  return Parsed{.left_out = "packets of other link types than SocketCAN, SLL and SLL2"};
}

}  // namespace canhil::logs
