// A CAN frame, classic or FD, independent of sockets and time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace canhil {

/// A data frame of CAN or CAN FD, or an error frame as SocketCAN reports it. In an error frame, `id` contains
/// the bits of the error class.
struct Frame {
  static constexpr std::size_t max_size = 64;

  std::uint32_t id = 0;   ///< 11 or 29 bits, without flags
  std::uint8_t size = 0;  ///< number of data bytes
  bool extended = false;  ///< 29-bit id
  bool fd = false;        ///< CAN FD format
  bool brs = false;       ///< CAN FD with bit rate switch: the data phase has the higher bit rate
  bool esi = false;       ///< CAN FD with error state indicator: the sender was error passive
  bool error = false;     ///< error frame
  /// The scaled signals follow the payload as doubles. Such frames exist only inside one process.
  bool unrounded = false;
  std::array<std::uint8_t, max_size> data{};

  /// The data bytes of the frame.
  [[nodiscard]] std::span<const std::uint8_t> payload() const { return {data.data(), size}; }

  friend bool operator==(const Frame& a, const Frame& b) {
    return a.id == b.id && a.size == b.size && a.extended == b.extended && a.fd == b.fd && a.brs == b.brs &&
           a.esi == b.esi && a.error == b.error && std::ranges::equal(a.payload(), b.payload()) &&
           a.unrounded == b.unrounded && (!a.unrounded || a.data == b.data);
  }
};

}  // namespace canhil
