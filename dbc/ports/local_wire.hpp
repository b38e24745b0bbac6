// What travels over the sockets of the embedded bus, between processes of one machine and one build.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "dbc/ports/port.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::local {

/// One frame: the header and only as many bytes of data as it has, so 24 bytes for a full classic frame.
struct Datagram {
  enum Flag : std::uint8_t { extended = 1, fd = 2, brs = 4, error = 8, own = 16 };

  std::uint32_t id = 0;
  std::uint8_t size = 0;
  std::uint8_t flags = 0;
  std::uint16_t unused = 0;
  std::int64_t t_ns = 0;  ///< the hub's stamp, CLOCK_MONOTONIC; 0 on the way to the hub
  std::array<std::uint8_t, Frame::max_size> data;

  [[nodiscard]] std::size_t bytes() const { return offsetof(Datagram, data) + size; }
};
static_assert(offsetof(Datagram, data) == 16);

/// The first thing a node says. Filtering is the hub's work, so that what a node does not want costs it
/// nothing.
struct Hello {
  std::uint32_t magic = expected_magic;
  std::uint8_t own_echo = 0;
  std::uint8_t only_some = 0;              ///< wanted counts
  std::array<std::uint8_t, 256> wanted{};  ///< one bit a standard id
  std::array<char, 66> node_name{};        ///< ends in 0

  static constexpr std::uint32_t expected_magic = 0x31484843;  // "CHH1"
};

using IdSet = std::bitset<2048>;  ///< of standard ids

/// The frame as a datagram; only the first bytes() of it are set.
void encode(const Frame& frame, Datagram& datagram);
/// The frame of a datagram of so many bytes, into a fresh one; false if they make no frame that the bus can
/// carry.
bool decode(const Datagram& datagram, std::size_t received, bool fd_bus, Frame& frame);

/// The set of the ids; error if one is not a standard id.
Result<IdSet> id_set(const std::vector<std::uint32_t>& ids);

/// What `local:NAME?bitrate=500000` says. What follows the name counts for the host only: a node that joins
/// may say it or not.
struct BusName {
  std::string name;
  WireSettings wire{};
};

/// Error: the line that says which names and keys there are.
Result<BusName> bus_name(std::string_view bus);

}  // namespace canhil::local
