// End-to-end protection (E2E) according to AUTOSAR profile 11 variant A (PRS_E2EProtocol). Byte 0 of a frame
// is a CRC-8 with the SAE J1850 polynomial 0x1D and start value 0. The CRC covers the 16-bit data id (low
// byte first; the data id is not sent) and all bytes of the frame after byte 0. The low nibble of byte 1 is a
// counter from 0 to 14.
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
    7;  // bytes per step: after the CRC byte, an 8-byte frame needs one step, a 64-byte frame nine steps

// advance[k][b] is the CRC of byte b followed by k zero bytes. The CRC is linear, so the CRC of several bytes
// is the XOR of such entries. The look-ups of the entries do not depend on each other. In a loop over single
// bytes, each look-up would have to wait for the previous one.
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

/// The CRC of all bytes of a frame after byte 0, for a data id. `data` is the whole frame and has 2..64
/// bytes.
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

/// Writes the counter (0..14) and the CRC into a packed frame.
constexpr void protect(std::span<std::uint8_t> data, std::uint16_t data_id, std::uint8_t counter) {
  data[1] = static_cast<std::uint8_t>((data[1] & 0xF0U) | counter);
  data[0] = crc(data, data_id);
}

/// The counter in a protected frame.
constexpr std::uint8_t counter(std::span<const std::uint8_t> data) { return data[1] & 0x0FU; }

/// The counter value that follows `counter`.
constexpr std::uint8_t next(std::uint8_t counter) {
  return static_cast<std::uint8_t>(counter + 1 == counter_period ? 0 : counter + 1);
}

/// The result of the check of a received frame. The result also depends on the counter that the receiver
/// stored last.
enum class Check : std::uint8_t {
  ok,         ///< CRC right, counter as expected
  some_lost,  ///< CRC right, but the counter jumped: frames were lost
  repeated,   ///< CRC right, but the counter is that of the previous frame: not new
  wrong_crc   ///< CRC, counter or size wrong: discard the frame
};

/// Stores the last counter of one received message.
class Receiver {
 public:
  /// Checks a frame, and stores its counter if the result is not wrong_crc.
  constexpr Check check(std::span<const std::uint8_t> data, std::uint16_t data_id) {
    lost_ = 0;
    if (data.size() < 2 || data[0] != crc(data, data_id) || counter(data) >= counter_period)
      return Check::wrong_crc;
    const std::uint8_t now = counter(data);
    const std::uint8_t before = last_;
    last_ = now;
    if (before == none) return Check::ok;
    if (now == next(before)) return Check::ok;
    if (now == before) return Check::repeated;
    lost_ = (now + counter_period - before - 1) % counter_period;
    return Check::some_lost;
  }
  /// The number of frames that were lost before the frame that was checked last (0..13).
  [[nodiscard]] constexpr int lost() const { return lost_; }
  /// Deletes the stored counter. For the next frame, check() returns ok or wrong_crc.
  constexpr void reset() { last_ = none; }

 private:
  static constexpr std::uint8_t none = 0xFF;
  std::uint8_t last_ = none;
  int lost_ = 0;
};

}  // namespace canhil::e2e
