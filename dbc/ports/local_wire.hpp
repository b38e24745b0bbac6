// Datagrams on the sockets of the embedded bus. They are exchanged between processes of one machine and one
// build.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "dbc/ports/port.hpp"
#include "dbc/ports/wire_settings.hpp"

namespace canhil::local {

/// A frame as a datagram. It has a header and those data bytes that the frame uses: in total 24 bytes for a
/// classic frame of 8 bytes.
struct Datagram {
  enum Flag : std::uint8_t { extended = 1, fd = 2, brs = 4, error = 8, own = 16, esi = 32 };

  std::uint32_t id = 0;
  std::uint8_t size = 0;
  std::uint8_t flags = 0;
  std::uint16_t unused = 0;
  std::int64_t t_ns = 0;  ///< time stamp of the hub, CLOCK_MONOTONIC; 0 in datagrams to the hub
  std::array<std::uint8_t, Frame::max_size> data;

  [[nodiscard]] std::size_t bytes() const { return offsetof(Datagram, data) + size; }
};
static_assert(offsetof(Datagram, data) == 16);

/// Several datagrams in one message of the socket, for nodes that take them (Hello::together): one system
/// call, and the node wakes up once. The next datagram begins stride() after the one before.
constexpr std::size_t most_together = 16;
using Together = std::array<std::byte, most_together * sizeof(Datagram)>;
inline std::size_t stride(const Datagram& datagram) { return (datagram.bytes() + 7) / 8 * 8; }

/// The first datagram of a node. It contains the filter of the node. The hub applies the filter, so that
/// unwanted frames cost the node nothing.
struct Hello {
  enum Wish : std::uint8_t { own_echo = 1, together = 2 };

  std::uint32_t magic = expected_magic;
  std::uint8_t wishes = 0;                 ///< see Wish
  std::uint8_t only_some = 0;              ///< if not 0, the hub delivers only the wanted ids
  std::array<std::uint8_t, 256> wanted{};  ///< one bit for each standard id
  std::array<char, 66> node_name{};        ///< the last character is 0

  static constexpr std::uint32_t expected_magic = 0x31484843;  // "CHH1"
};

using IdSet = std::bitset<2048>;  ///< a set of standard ids

/// Encodes a frame into a datagram. Sets only the first bytes() bytes of the datagram.
void encode(const Frame& frame, Datagram& datagram);
/// Decodes a datagram of `received` bytes into `frame`, which must be default-constructed. False: the bus
/// cannot carry such a frame.
bool decode(const Datagram& datagram, std::size_t received, bool fd_bus, Frame& frame);

/// Sends frames over a socket, several in one message, with the stamp t_ns, to a node that takes them so.
/// Returns how many the socket took, up to the first frame that the bus cannot carry.
std::size_t send_together(int socket, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns);

/// The same with a message for each frame.
std::size_t send_frames(int socket, std::span<const Frame> frames, bool fd_bus, std::int64_t t_ns);

/// Converts a list of ids to a set. Returns an error if an id is not a standard id.
Result<IdSet> id_set(const std::vector<std::uint32_t>& ids);

/// The parts of a name such as `local:NAME?bitrate=500000`. The settings after NAME have an effect only for
/// the host; a node that joins may omit them.
struct BusName {
  std::string name;
  WireSettings wire{};
};

/// Splits the name of a bus into its parts. An error is one line with the valid names and keys.
Result<BusName> bus_name(std::string_view bus);

}  // namespace canhil::local
