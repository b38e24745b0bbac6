// Datagrams on the sockets of the embedded bus, between processes of one machine and one build.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dbc/ports/port.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::local {

/// One frame: the header and only the data bytes in use: 24 bytes for a full classic frame.
struct Datagram {
  enum Flag : std::uint8_t { extended = 1, fd = 2, brs = 4, error = 8, own = 16 };

  std::uint32_t id = 0;
  std::uint8_t size = 0;
  std::uint8_t flags = 0;
  std::uint16_t unused = 0;
  std::int64_t t_ns = 0;  ///< the hub's stamp, CLOCK_MONOTONIC; 0 when sent to the hub
  std::array<std::uint8_t, Frame::max_size> data;

  [[nodiscard]] std::size_t bytes() const { return offsetof(Datagram, data) + size; }
};
static_assert(offsetof(Datagram, data) == 16);

/// A node's first datagram. The hub filters, so that unwanted frames cost the node nothing.
struct Hello {
  std::uint32_t magic = expected_magic;
  std::uint8_t own_echo = 0;
  std::uint8_t only_some = 0;              ///< not 0: deliver only the wanted ids
  std::array<std::uint8_t, 256> wanted{};  ///< one bit for each standard id
  std::array<char, 66> node_name{};        ///< ends in 0

  static constexpr std::uint32_t expected_magic = 0x31484843;  // "CHH1"
};

using IdSet = std::bitset<2048>;  ///< of standard ids

/// Encodes a frame; sets only the first bytes() bytes of the datagram.
void encode(const Frame& frame, Datagram& datagram);
/// Decodes a datagram of `received` bytes into a default-constructed frame; false if the bus cannot carry
/// such a frame.
bool decode(const Datagram& datagram, std::size_t received, bool fd_bus, Frame& frame);

/// The ids as a set. Error: an id is not a standard one.
Result<IdSet> id_set(const std::vector<std::uint32_t>& ids);

/// The parts of `local:NAME?bitrate=500000`. The settings after the name apply to the host only; a joining
/// node may give or omit them.
struct BusName {
  std::string name;
  WireSettings wire{};
};

/// Error: one line with the valid names and keys.
Result<BusName> bus_name(std::string_view bus);

}  // namespace canhil::local
