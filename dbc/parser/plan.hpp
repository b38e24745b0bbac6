// A plan contains, for each signal of a message, the position of its bits, the conversion to a number, and
// the condition for its presence. A plan is made once, when a DBC is read. Decoding and encoding with a plan
// allocate no memory. The results are bit-identical to those of generated code, because both use
// dbc/wire/quantise.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dbc/parser/database.hpp"

namespace canhil::dbc {

/// The position of a signal in a message. It consists of a window of eight bytes, and of the shift and the
/// mask that extract the signal from this window. A signal of 58 bits or more may also have bits in a ninth
/// byte.
struct BitPlacement {
  std::uint64_t mask = 0;
  std::uint8_t first_byte = 0;  ///< first byte of the window
  std::uint8_t shift = 0;       ///< number of bits of the window below the lowest bit of the signal
  std::uint8_t ninth_bits = 0;  ///< how many bits of the signal are in the byte after the window
  bool big_endian = false;

  BitPlacement() = default;
  /// The position in data of at least `size` bytes. All bits of the signal must be in these bytes.
  BitPlacement(const Signal& signal, std::size_t size);

  /// The bits of the signal, right-aligned. `data` must have at least eight bytes.
  [[nodiscard]] std::uint64_t raw(const std::uint8_t* data) const;
  /// Writes the bits of the signal, and does not change other bits.
  void put(std::uint64_t raw, std::uint8_t* data) const;
};

/// Converts raw bits to a physical value: raw * scale + offset.
struct Conversion {
  /// The meaning of the raw bits; wide_unsigned: an unsigned integer of 64 bits.
  enum class Kind : std::uint8_t { integer, wide_unsigned, float32, float64 };

  double scale = 1;
  double offset = 0;
  std::uint64_t mask = 0;
  std::uint64_t sign_bit = 0;  ///< mask of the sign bit of a signed integer
  Kind kind = Kind::integer;
  bool is_plain = true;  ///< true: the scale is 1 and the offset is 0

  Conversion() = default;
  /// The conversion of a signal.
  explicit Conversion(const Signal& signal);

  /// Converts raw bits to a signed integer.
  [[nodiscard]] std::int64_t sign_extended(std::uint64_t raw) const {
    return static_cast<std::int64_t>((raw ^ sign_bit) - sign_bit);
  }
  /// Converts raw bits to a physical value, in the unit of the signal.
  [[nodiscard]] double physical(std::uint64_t raw) const;
};

/// The limits of the raw value. They are applied before rounding.
struct RawLimits {
  double lowest = 0;
  double highest = 0;

  RawLimits() = default;
  /// The limits of a signal, which follow from its bits and from [minimum, maximum].
  explicit RawLimits(const Signal& signal);
};

/// Converts a physical value to raw bits, right-aligned. A raw value outside the limits becomes the nearest
/// limit. The raw value of an integer signal is rounded half to even. NaN becomes the minimum.
std::uint64_t quantised(const Conversion& conversion, const RawLimits& limits, double value);

/// A plan for the decoding and encoding of one message at run time.
class MessagePlan {
 public:
  /// Makes the plan for a message from the parser.
  explicit MessagePlan(const Message& message);

  /// The number of bytes of the message.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The number of signals. The index of a signal is the same as in Message::signals.
  [[nodiscard]] std::size_t signals() const { return steps_.size(); }

  /// Writes the physical value of every signal of the message into `values`; NaN if the frame does not
  /// contain the signal. Returns false and writes nothing in two cases: `data` is shorter than the message,
  /// or `values` has fewer elements than the message has signals.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> data, std::span<double> values) const;

  /// Encodes physical values. Unused bits are 0. Signals that the multiplexors do not select are not written.
  /// If two signals overlap, the signal with more multiplexors above it overwrites the other; if both signals
  /// have the same number of multiplexors, the later signal overwrites the earlier one. Bytes beyond the
  /// message do not change. Returns false and writes nothing in the same cases as decode().
  [[nodiscard]] bool encode(std::span<const double> values, std::span<std::uint8_t> data) const;

  /// Whether the frame contains the signal with this index, i.e. whether every multiplexor above the signal
  /// has a value that selects the signal. `data` must have the length of the message.
  [[nodiscard]] bool is_present(std::size_t signal, std::span<const std::uint8_t> data) const;

 private:
  static constexpr std::uint32_t always = UINT32_MAX;

  struct Step {
    BitPlacement bits;
    Conversion conversion;
    std::uint32_t multiplexor = always;  ///< index of the signal that is the multiplexor
    std::uint32_t first_range = 0, end_range = 0;
  };

  // A signal of a message that is one word: at most eight bytes, with integers that are always present and do
  // not overlap. Nearly all messages of classic CAN are such. Then the message is loaded and stored once, and
  // no signal needs a branch.
  struct Field {
    explicit Field(const Step& step, const RawLimits& limits);
    std::uint64_t mask = 0, sign_bit = 0;
    double scale = 1;
    double added = 0, subtracted = 0;  // the offset; if it is 0: the zero that changes no number
    RawLimits limits;
    std::uint8_t shift = 0;
    bool big_endian = false;
  };

  void find_fields();
  void decode_word(std::uint64_t word, double* values) const;
  [[nodiscard]] std::uint64_t encode_word(const double* values) const;
  [[nodiscard]] std::size_t multiplexors_above(std::uint32_t signal) const;
  [[nodiscard]] bool holds(const Step& step, const std::uint8_t* data) const;

  std::size_t size_ = 0;
  std::vector<Step> steps_;
  std::vector<RawLimits> limits_;
  std::vector<MuxRange> ranges_;      ///< ranges of all signals, one signal after the other
  std::vector<std::uint32_t> order_;  ///< indices in the order of encoding: a multiplexor before its signals
  std::vector<Field> fields_;         ///< of a message that is one word; otherwise empty
};

}  // namespace canhil::dbc
