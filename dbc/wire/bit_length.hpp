// The length of a frame on the wire, in bits: the exact length for a given content, and the largest length
// for a given size. The duration of the frame and the bus load are computed from the length.
//
// All lengths include the acknowledgement and the intermission of 3 bits before the next frame. The layouts
// of the frames are those of ISO 11898-1:2015, 10.4. The sender is assumed to be error active (bit ESI of FD
// frames).
#pragma once

#include <cstdint>

#include "dbc/wire/frame.hpp"

namespace canhil::wire {

/// How many bits are sent at the nominal bit rate, and how many at the data bit rate. Only FD frames with bit
/// rate switch have bits at the data bit rate. The rate changes at the sample points of the bit BRS and of
/// the CRC delimiter. Together, these two bits take the time of one nominal bit and one data bit. Therefore
/// BRS is counted as a nominal bit and the delimiter as a data bit.
struct BitLength {
  std::int64_t nominal = 0;
  std::int64_t data = 0;

  constexpr BitLength& operator+=(const BitLength& other) {
    nominal += other.nominal;
    data += other.data;
    return *this;
  }
  /// The number of all bits, at both rates.
  [[nodiscard]] constexpr std::int64_t bits() const { return nominal + data; }
  friend constexpr bool operator==(const BitLength&, const BitLength&) = default;
};

/// Bit rates [bit/s]; nominal must be above 0.
struct BitRates {
  std::int64_t nominal = 0;
  std::int64_t data = 0;  ///< rate in the data phase of FD frames; 0: the same as nominal
};

/// The bits that a sender puts on the wire. BitStream counts these bits, including the stuff bits, and
/// computes the CRC of classic frames.
class BitStream {
 public:
  /// Appends a bit. If a stuff bit is due, appends it before this bit.
  constexpr void put(bool bit) {
    if (run_ == longest_run) stuff();
    run_ = bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    ++length_;
    const bool feedback = bit != ((crc_ >> 14U & 1U) != 0);
    crc_ = (crc_ << 1U & 0x7FFFU) ^ (feedback ? crc15_polynomial : 0);
  }
  /// Appends the lowest `count` bits of `value`, the most significant of them first.
  constexpr void put(std::uint32_t value, int count) {
    while (count-- > 0) put((value >> static_cast<unsigned>(count) & 1U) != 0);
  }
  /// Ends the stream: if its last five bits are equal, appends a stuff bit.
  constexpr void close() {
    if (run_ == longest_run) stuff();
  }
  /// The number of bits so far, with stuff bits.
  [[nodiscard]] constexpr int length() const { return length_; }
  /// The CRC of the bits so far, without stuff bits.
  [[nodiscard]] constexpr std::uint32_t crc15() const { return crc_; }

 private:
  static constexpr int longest_run = 5;
  static constexpr std::uint32_t crc15_polynomial = 0x4599;

  constexpr void stuff() {
    ++length_;
    last_ = !last_;
    run_ = 1;
  }

  bool last_ = false;
  int run_ = 0;
  int length_ = 0;
  std::uint32_t crc_ = 0;
};

/// The intermission follows every frame and is sent at the nominal bit rate. The time stamp of a frame is the
/// time at which the intermission after the frame begins.
inline constexpr std::int64_t intermission_bits = 3;

/// The number of bits after the CRC delimiter. The three terms are: the acknowledgement with its delimiter;
/// the end of frame; the intermission.
inline constexpr std::int64_t frame_end_bits = 2 + 7 + intermission_bits;

/// The data length code of a size. There must be a data length code for this size.
constexpr std::uint32_t data_length_code(unsigned size) {
  if (size <= 8) return size;
  if (size <= 24) return 9 + (size - 12) / 4;
  return size == 32 ? 13 : size == 48 ? 14 : 15;
}

/// The number of bits of the stuff count, the CRC and the CRC delimiter of an FD frame. In stuff count and
/// CRC, there is a fixed stuff bit before every four bits.
constexpr int fd_crc_field_bits(unsigned size) {
  const int bits = 4 + (size <= 16 ? 17 : 21);
  return bits + (bits + 3) / 4 + 1;
}

/// The exact length of a frame on the wire; 0 for an error frame, because its length on the wire is unknown.
constexpr BitLength bit_length(const Frame& frame) {
  if (frame.error) return {};
  BitStream wire;
  wire.put(false);  // start of frame
  if (frame.extended) {
    wire.put(frame.id >> 18U, 11);
    wire.put(0b11, 2);  // SRR, IDE
    wire.put(frame.id, 18);
    wire.put(false);                 // RTR, in FD frames RRS
    if (!frame.fd) wire.put(false);  // r1
  } else {
    wire.put(frame.id, 11);
    wire.put(0b00, 2);  // RTR (in FD frames RRS), IDE
  }
  if (!frame.fd) {
    wire.put(false);  // r0
    wire.put(data_length_code(frame.size), 4);
    for (const std::uint8_t byte : frame.payload()) wire.put(byte, 8);
    wire.put(wire.crc15(), 15);
    wire.close();
    return {.nominal = wire.length() + 1 + frame_end_bits};  // the 1 is the CRC delimiter
  }
  wire.put(frame.brs ? 0b101 : 0b100, 3);  // FDF, res, BRS
  const int arbitration = wire.length();
  wire.put(frame.esi);
  wire.put(data_length_code(frame.size), 4);
  for (const std::uint8_t byte : frame.payload()) wire.put(byte, 8);
  // close() is not called: if a stuff bit is due after the data, the first fixed stuff bit replaces it.
  const int data = wire.length() - arbitration + fd_crc_field_bits(frame.size);
  if (!frame.brs) return {.nominal = arbitration + data + frame_end_bits};
  return {.nominal = arbitration + frame_end_bits, .data = data};
}

/// The largest length of a classic frame of size s: g + 8 s + 13 + floor((g + 8 s - 1) / 4) bits, where g is
/// 34 for an 11-bit id and 54 for a 29-bit id (Davis, Burns, Bril, Lukkien 2007, eq. 1).
constexpr BitLength worst_case_length(unsigned size, bool extended) {
  const std::int64_t stuffed = (extended ? 54 : 34) + 8 * static_cast<std::int64_t>(size);
  return {.nominal = stuffed + 13 + (stuffed - 1) / 4};
}

/// The largest length of an FD frame of size s. From the start of frame to BRS, there are 17 bits (11-bit id)
/// or 36 bits (29-bit id). FDF = 1 and res = 0 end every run of equal bits. Therefore stuff bits occur only
/// in the 14 or 33 bits before FDF: at most floor((14 - 1) / 4) = 3 or floor((33 - 1) / 4) = 8. From ESI to
/// the last data bit, there are 5 + 8 s bits. A run of equal bits may begin before ESI: without bit rate
/// switch two bits before it, at res; with bit rate switch one bit before it, at BRS. A stuff bit that is due
/// after the last data bit is replaced by a fixed stuff bit. So a run may extend over n = 2 + 5 + 8 s bits.
/// These bits have at most floor((n - 2) / 4) = 1 + 2 s stuff bits, also for error passive senders (ESI = 1).
constexpr BitLength worst_case_fd_length(unsigned size, bool extended, bool brs) {
  const std::int64_t arbitration = extended ? 36 + 8 : 17 + 3;
  const std::int64_t s = size;
  const std::int64_t data = 5 + 8 * s + 1 + 2 * s + fd_crc_field_bits(size);
  if (!brs) return {.nominal = arbitration + data + frame_end_bits};
  return {.nominal = arbitration + frame_end_bits, .data = data};
}

/// The duration of frames with this length [s].
constexpr double duration_s(const BitLength& length, const BitRates& rates) {
  const std::int64_t data_rate = rates.data > 0 ? rates.data : rates.nominal;
  return static_cast<double>(length.nominal) / static_cast<double>(rates.nominal) +
         static_cast<double>(length.data) / static_cast<double>(data_rate);
}

/// The duration of a single frame [ns], rounded up.
constexpr std::int64_t duration_ns(const BitLength& length, const BitRates& rates) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  const auto rounded_up = [](std::int64_t bits, std::int64_t rate) {
    return rate > 0 ? (bits * ns_per_s + rate - 1) / rate : 0;
  };
  return rounded_up(length.nominal, rates.nominal) +
         rounded_up(length.data, rates.data > 0 ? rates.data : rates.nominal);
}

/// The fraction of an interval during which frames with the total length `sum` occupy the bus; 1 means a full
/// bus. The interval must be above 0.
constexpr double bus_load(const BitLength& sum, double interval_s, const BitRates& rates) {
  return duration_s(sum, rates) / interval_s;
}

}  // namespace canhil::wire
