// A message compiled for the run-time codec: for each signal its bits, its conversion to a number, and the
// condition for its presence. Built once when a DBC is read; using it allocates nothing. Results equal those
// of generated code bit for bit: both use dbc/wire/quantise.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The position of a signal: a window of eight bytes with shift and mask. A signal of 58 bits or more may
/// reach into a ninth byte.
struct BitPlacement {
  std::uint64_t mask = 0;
  std::uint8_t first_byte = 0;  ///< of the window
  std::uint8_t shift = 0;       ///< from the least significant bit of the window to that of the signal
  std::uint8_t ninth_bits = 0;  ///< number of the signal's bits in the byte after the window
  bool big_endian = false;

  BitPlacement() = default;
  /// For data of at least `size` bytes that contain all bits of the signal.
  BitPlacement(const Signal& signal, std::size_t size);

  /// The signal's bits, right-aligned. The data has at least eight bytes.
  [[nodiscard]] std::uint64_t raw(const std::uint8_t* data) const;
  /// Writes the signal's bits; does not change other bits.
  void put(std::uint64_t raw, std::uint8_t* data) const;
};

/// Converts raw bits to a physical value: raw * scale + offset.
struct Conversion {
  /// How the raw bits are read; wide_unsigned: 64 bits without a sign.
  enum class Kind : std::uint8_t { integer, wide_unsigned, float32, float64 };

  double scale = 1;
  double offset = 0;
  std::uint64_t mask = 0;
  std::uint64_t sign_bit = 0;  ///< of a signed integer
  Kind kind = Kind::integer;
  bool is_plain = true;  ///< scale 1, offset 0

  Conversion() = default;
  /// The conversion of a signal.
  explicit Conversion(const Signal& signal);

  /// Raw bits as a signed integer.
  [[nodiscard]] std::int64_t sign_extended(std::uint64_t raw) const {
    return static_cast<std::int64_t>((raw ^ sign_bit) - sign_bit);
  }
  /// Raw bits as a physical value, in the signal's unit.
  [[nodiscard]] double physical(std::uint64_t raw) const;
};

/// The limits of the raw number before rounding.
struct RawLimits {
  double lowest = 0;
  double highest = 0;

  RawLimits() = default;
  /// The limits of a signal: its bits, and [minimum, maximum].
  explicit RawLimits(const Signal& signal);
};

/// Raw bits, right-aligned, of a physical value: rounded half to even, saturated to the limits; NaN becomes
/// the minimum.
std::uint64_t quantised(const Conversion& conversion, const RawLimits& limits, double value);

/// A message compiled for decoding and encoding at run time.
class MessagePlan {
 public:
  /// For a message from the parser.
  explicit MessagePlan(const Message& message);

  /// Bytes of the message.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The number of signals; they are numbered as in Message::signals.
  [[nodiscard]] std::size_t signals() const { return steps_.size(); }

  /// Writes the physical value of every signal in the frame, NaN for absent signals. Returns false and writes
  /// nothing if the data is shorter than the message, or if `values` has fewer elements than the message has
  /// signals.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> data, std::span<double> values) const;

  /// Encodes physical values. Unused bits are 0; signals that the multiplexors do not select are not written;
  /// where signals overlap, the one with more multiplexors above it wins, otherwise the later one. Bytes
  /// beyond the message do not change. Returns false and writes nothing in the same cases as decode().
  [[nodiscard]] bool encode(std::span<const double> values, std::span<std::uint8_t> data) const;

  /// Whether the frame holds a signal: every multiplexor above it has one of the values that select it. The
  /// data has the length of the message.
  [[nodiscard]] bool is_present(std::size_t signal, std::span<const std::uint8_t> data) const;

 private:
  static constexpr std::uint32_t always = UINT32_MAX;

  struct Step {
    BitPlacement bits;
    Conversion conversion;
    std::uint32_t multiplexor = always;  ///< index of the multiplexor's signal
    std::uint32_t first_range = 0, end_range = 0;
  };

  [[nodiscard]] std::size_t multiplexors_above(std::uint32_t signal) const;
  [[nodiscard]] bool holds(const Step& step, const std::uint8_t* data) const;

  std::size_t size_ = 0;
  std::vector<Step> steps_;
  std::vector<RawLimits> limits_;
  std::vector<MuxRange> ranges_;      ///< of all signals
  std::vector<std::uint32_t> order_;  ///< order of encoding: multiplexors before the signals that they select
};

}  // namespace canhil::dbc
