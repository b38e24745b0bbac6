// The length of a frame on the wire: exact from its content, worst case from its size. From the length follow
// the frame's duration and the bus load.
//
// All lengths include the acknowledgement and the intermission of 3 bits before the next frame. Layouts:
// ISO 11898-1:2015, 10.4. The sender is assumed to be error active (bit ESI of FD frames).
#pragma once

#include <cstdint>

#include "dbc/wire/frame.hpp"

namespace canhil::wire {

/// Bits at the nominal bit rate and, in an FD frame with bit rate switch, at the data bit rate. The rate
/// switches at the sample points of BRS and of the CRC delimiter. Together these two bits last one nominal
/// and one data bit, so BRS counts as nominal and the delimiter as data.
struct BitLength {
  std::int64_t nominal = 0;
  std::int64_t data = 0;

  constexpr BitLength& operator+=(const BitLength& other) {
    nominal += other.nominal;
    data += other.data;
    return *this;
  }
  /// All bits, whatever their rate.
  [[nodiscard]] constexpr std::int64_t bits() const { return nominal + data; }
  friend constexpr bool operator==(const BitLength&, const BitLength&) = default;
};

/// Bit rates [bit/s]; nominal must be above 0.
struct BitRates {
  std::int64_t nominal = 0;
  std::int64_t data = 0;  ///< in the data phase of FD frames; 0: same as nominal
};

/// The bits that a sender puts on the wire: counts them including stuff bits, and computes the CRC of classic
/// frames.
class BitStream {
 public:
  /// Appends a bit, and a stuff bit before it where one is due.
  constexpr void put(bool bit) {
    if (run_ == longest_run) stuff();
    run_ = bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    ++length_;
    const bool feedback = bit != ((crc_ >> 14U & 1U) != 0);
    crc_ = (crc_ << 1U & 0x7FFFU) ^ (feedback ? crc15_polynomial : 0);
  }
  /// Appends the low `count` bits of `value`, most significant first.
  constexpr void put(std::uint32_t value, int count) {
    while (count-- > 0) put((value >> static_cast<unsigned>(count) & 1U) != 0);
  }
  /// Adds the stuff bit that is due if the stream ends with five equal bits.
  constexpr void close() {
    if (run_ == longest_run) stuff();
  }
  /// Bits so far, with stuff bits.
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

/// The intermission follows every frame, at the nominal bit rate. The stamp of a frame is the time at
/// which its intermission begins.
inline constexpr std::int64_t intermission_bits = 3;

/// Acknowledgement with delimiter, end of frame, intermission.
inline constexpr std::int64_t frame_end_bits = 2 + 7 + intermission_bits;

/// The data length code of a size; the size must have one.
constexpr std::uint32_t data_length_code(unsigned size) {
  if (size <= 8) return size;
  if (size <= 24) return 9 + (size - 12) / 4;
  return size == 32 ? 13 : size == 48 ? 14 : 15;
}

/// Stuff count, CRC and CRC delimiter of an FD frame; a fixed stuff bit precedes every four bits of stuff
/// count and CRC.
constexpr int fd_crc_field_bits(unsigned size) {
  const int bits = 4 + (size <= 16 ? 17 : 21);
  return bits + (bits + 3) / 4 + 1;
}

/// The length of a frame with this content. 0 for an error frame, whose length on the wire is unknown.
constexpr BitLength bit_length(const Frame& frame) {
  if (frame.error) return {};
  BitStream wire;
  wire.put(false);  // start of frame
  if (frame.extended) {
    wire.put(frame.id >> 18U, 11);
    wire.put(0b11, 2);  // SRR, IDE
    wire.put(frame.id, 18);
    wire.put(false);                 // RTR; RRS in FD frames
    if (!frame.fd) wire.put(false);  // r1
  } else {
    wire.put(frame.id, 11);
    wire.put(0b00, 2);  // RTR or RRS, IDE
  }
  if (!frame.fd) {
    wire.put(false);  // r0
    wire.put(data_length_code(frame.size), 4);
    for (const std::uint8_t byte : frame.payload()) wire.put(byte, 8);
    wire.put(wire.crc15(), 15);
    wire.close();
    return {.nominal = wire.length() + 1 + frame_end_bits};  // 1: CRC delimiter
  }
  wire.put(frame.brs ? 0b101 : 0b100, 3);  // FDF, res, BRS
  const int arbitration = wire.length();
  wire.put(data_length_code(frame.size), 5);  // ESI (0: error active), DLC
  for (const std::uint8_t byte : frame.payload()) wire.put(byte, 8);
  // close() is not called: if a stuff bit is due after the data, the first fixed stuff bit takes its place.
  const int data = wire.length() - arbitration + fd_crc_field_bits(frame.size);
  if (!frame.brs) return {.nominal = arbitration + data + frame_end_bits};
  return {.nominal = arbitration + frame_end_bits, .data = data};
}

/// The largest length of a classic frame of size s: g + 8 s + 13 + floor((g + 8 s - 1) / 4) bits, where g is
/// 34 for 11-bit ids, 54 for 29-bit ones (Davis, Burns, Bril, Lukkien 2007, eq. 1).
constexpr BitLength worst_case_length(unsigned size, bool extended) {
  const std::int64_t stuffed = (extended ? 54 : 34) + 8 * static_cast<std::int64_t>(size);
  return {.nominal = stuffed + 13 + (stuffed - 1) / 4};
}

/// The largest length of an FD frame of size s.
/// Up to BRS there are 17 bits (11-bit id) or 36 bits (29-bit id). FDF = 1 and res = 0 end every run, so
/// stuff bits fall into the 14 or 33 bits before them: at most floor((14 - 1) / 4) = 3 or floor((33 - 1) / 4)
/// = 8. From ESI to the last data bit there are 5 + 8 s bits. A run may begin before ESI: two bits earlier at
/// res (without bit rate switch) or one bit earlier at BRS (with it). A stuff bit due after the last bit is a
/// fixed one. So there are at most floor((5 + 8 s + 2 - 2) / 4) = 1 + 2 s stuff bits, also for error passive
/// senders (ESI = 1).
constexpr BitLength worst_case_fd_length(unsigned size, bool extended, bool brs) {
  const std::int64_t arbitration = extended ? 36 + 8 : 17 + 3;
  const std::int64_t s = size;
  const std::int64_t data = 5 + 8 * s + 1 + 2 * s + fd_crc_field_bits(size);
  if (!brs) return {.nominal = arbitration + data + frame_end_bits};
  return {.nominal = arbitration + frame_end_bits, .data = data};
}

/// The duration of a length [s].
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

/// The fraction of an interval (above 0) during which frames with this total length occupy the bus; 1: full.
constexpr double bus_load(const BitLength& sum, double interval_s, const BitRates& rates) {
  return duration_s(sum, rates) / interval_s;
}

}  // namespace canhil::wire
