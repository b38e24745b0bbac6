// A CAN frame, classic or FD, independent of sockets and time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace canhil {

/// One CAN or CAN FD data frame, or an error frame as SocketCAN reports it (id then holds the error class
/// bits).
struct Frame {
  static constexpr std::size_t max_size = 64;

  std::uint32_t id = 0;    ///< 11 or 29 bits, without flags
  std::uint8_t size = 0;   ///< bytes of data in use
  bool extended = false;   ///< 29-bit id
  bool fd = false;         ///< CAN FD format
  bool brs = false;        ///< CAN FD: data phase at the higher bit rate
  bool error = false;      ///< error frame
  bool unrounded = false;  ///< scaled signals follow the payload as doubles: within one process only
  std::array<std::uint8_t, max_size> data{};

  /// The data bytes of the frame.
  [[nodiscard]] std::span<const std::uint8_t> payload() const { return {data.data(), size}; }

  friend bool operator==(const Frame& a, const Frame& b) {
    return a.id == b.id && a.size == b.size && a.extended == b.extended && a.fd == b.fd && a.brs == b.brs &&
           a.error == b.error && std::ranges::equal(a.payload(), b.payload()) && a.unrounded == b.unrounded &&
           (!a.unrounded || a.data == b.data);
  }
};

}  // namespace canhil
