// End-to-end protection, AUTOSAR E2E profile 11 variant A (PRS_E2EProtocol): CRC-8 SAE J1850 polynomial 0x1D
// with start value 0 in byte 0, over the 16-bit data id (low byte first, not sent) and bytes 1.. of the
// frame; a counter 0..14 in the low nibble of byte 1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace canhil::e2e {

/// Counters run from 0 to 14.
inline constexpr int counter_period = 15;  // the profile excludes the value 15

namespace detail {

inline constexpr std::size_t stride =
    7;  // bytes per step: an 8-byte frame has one step after the CRC byte, a 64-byte frame nine

// advance[k][b]: the CRC of byte b followed by k zero bytes. The CRC is linear, so the CRC of several bytes
// is the exclusive or of such entries. These look-ups are independent of each other, whereas in a loop over
// bytes each would wait for the previous one.
consteval std::array<std::array<std::uint8_t, 256>, stride> crc_tables() {
  std::array<std::array<std::uint8_t, 256>, stride> advance{};
  for (unsigned b = 0; b < 256; ++b) {
    unsigned c = b;
    for (auto& table : advance) {
      for (int bit = 0; bit < 8; ++bit)
        c = (c & 0x80U) != 0 ? ((c << 1U) ^ 0x1DU) & 0xFFU : (c << 1U) & 0xFFU;
      table[b] = static_cast<std::uint8_t>(c);
    }
  }
  return advance;
}
inline constexpr auto advance = crc_tables();

}  // namespace detail

/// CRC of a frame's bytes from byte 1 on, for a data id. Length: 2..64 bytes.
constexpr std::uint8_t crc(std::span<const std::uint8_t> data, std::uint16_t data_id) {
  using detail::advance;
  std::uint8_t c = static_cast<std::uint8_t>(advance[1][data_id & 0xFFU] ^ advance[0][data_id >> 8U]);
  std::size_t i = 1;
  for (; i + detail::stride <= data.size(); i += detail::stride) {
    c = static_cast<std::uint8_t>(advance[6][c ^ data[i]] ^ advance[5][data[i + 1]] ^
                                  advance[4][data[i + 2]] ^ advance[3][data[i + 3]] ^
                                  advance[2][data[i + 4]] ^ advance[1][data[i + 5]] ^
                                  advance[0][data[i + 6]]);
  }
  for (; i < data.size(); ++i) c = advance[0][c ^ data[i]];
  return c;
}

/// Writes counter (0..14) and CRC into a packed frame.
constexpr void protect(std::span<std::uint8_t> data, std::uint16_t data_id, std::uint8_t counter) {
  data[1] = static_cast<std::uint8_t>((data[1] & 0xF0U) | counter);
  data[0] = crc(data, data_id);
}

/// The counter of a protected frame.
constexpr std::uint8_t counter(std::span<const std::uint8_t> data) { return data[1] & 0x0FU; }

/// The counter after this one.
constexpr std::uint8_t next(std::uint8_t counter) {
  return static_cast<std::uint8_t>(counter + 1 == counter_period ? 0 : counter + 1);
}

/// The result of checking a received frame, given the frames before it.
enum class Check : std::uint8_t {
  ok,         ///< CRC right, counter follows
  some_lost,  ///< CRC right, counter jumped: frames were lost in between
  repeated,   ///< CRC right, same counter as before: not new
  wrong_crc   ///< discard the frame
};

/// Holds the last counter of one received message.
class Receiver {
 public:
  /// Checks a frame and stores its counter. lost() is then the number of frames lost before it (0..13).
  constexpr Check check(std::span<const std::uint8_t> data, std::uint16_t data_id) {
    lost_ = 0;
    if (data.size() < 2 || data[0] != crc(data, data_id) || counter(data) >= counter_period)
      return Check::wrong_crc;
    const std::uint8_t now = counter(data);
    const std::uint8_t before = last_;
    last_ = now;
    if (before == none) return Check::ok;
    if (now == before) return Check::repeated;
    lost_ = (now + counter_period - before - 1) % counter_period;
    return lost_ == 0 ? Check::ok : Check::some_lost;
  }
  /// The frames lost before the last checked one (0..13).
  [[nodiscard]] constexpr int lost() const { return lost_; }
  /// Forgets the last counter: the next frame with a right CRC is ok.
  constexpr void reset() { last_ = none; }

 private:
  static constexpr std::uint8_t none = 0xFF;
  std::uint8_t last_ = none;
  int lost_ = 0;
};

}  // namespace canhil::e2e
