// The fast packet of NMEA 2000: a message of 9 to 223 bytes in up to 32 classic frames of one id.
//
// Byte 0 of each frame has the sequence number of the message (3 bits, the upper ones) and the number of the
// frame (5 bits). The first frame has the number of bytes of the message in byte 1, and its first 6 bytes.
// Each further frame has 7 bytes. Bytes of the last frame that are not used are 0xFF.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace canhil::transport {

inline constexpr std::size_t fewest_fast_packet_bytes = 9, most_fast_packet_bytes = 223;

/// The number of frames of a message of 9 to 223 bytes.
constexpr std::size_t fast_packet_frames(std::size_t bytes) {
  constexpr std::size_t in_first = 6, in_others = 7;
  return 1 + (bytes - in_first + in_others - 1) / in_others;
}

using FastPacketFrame = std::array<std::uint8_t, 8>;

/// Splits a message of 9 to 223 bytes into frames. `sequence`: the lowest 3 bits are sent; a sender
/// increments them with each message of an id.
std::vector<FastPacketFrame> split_fast_packet(std::span<const std::uint8_t> message, unsigned sequence);

/// Puts the fast packets of one id together.
class FastPacketReceiver {
 public:
  /// Takes a frame. Returns the message that it completes; none: the message is not complete. The result is
  /// valid until the next call.
  std::optional<std::span<const std::uint8_t>> take(std::span<const std::uint8_t> frame);
  /// The number of messages that began but were not completed, or of which the first frame did not come.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// The number of messages that have begun and are not complete yet.
  [[nodiscard]] std::uint64_t open() const { return next_ != 0 ? 1 : 0; }

 private:
  void lose(unsigned sequence);

  std::vector<std::uint8_t> message_;
  std::size_t size_ = 0;
  unsigned sequence_ = 0, next_ = 0;  // next_: number of the next frame; 0: no message is open
  bool losing_ = false;               // frames of a message that counts as lost are still coming
  std::uint64_t lost_ = 0;
};

}  // namespace canhil::transport
