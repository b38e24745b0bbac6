// The settings for the protection of a message: counter, checksum, and fields with a constant value. Settings
// come from a profile (profiles.hpp) or from a file. A Protection (protection.hpp) is made from valid
// settings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dbc/protection/crc.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// The position of a field in a message, in DBC notation.
struct Place {
  /// The position of the least significant bit (Intel) or of the most significant bit (Motorola).
  unsigned start_bit = 0;
  unsigned length = 0;      ///< number of bits, 1..64
  bool big_endian = false;  ///< true: Motorola, false: Intel
  friend bool operator==(const Place&, const Place&) = default;
};

/// A counter that increases with each frame. Its values are 0..modulo - 1 without the skipped values; the
/// first value follows the last one.
struct Counter {
  Place place;
  std::uint64_t modulo = 0;            ///< 0: the number of values that fit the place
  std::vector<std::uint64_t> skipped;  ///< values below the modulo that are never sent
  /// Messages with the same `shared_as` share one counter. Empty: the counter is not shared.
  std::string shared_as;
  friend bool operator==(const Counter&, const Counter&) = default;
};

/// The source of a byte that a checksum covers in addition to the message's bytes.
enum class Source : std::uint8_t {
  constant,             ///< the byte is AddedByte::value
  data_id,              ///< byte AddedByte::index of the data id; index 0 is the least significant byte
  data_id_alternating,  ///< byte 0 of the data id for an even counter, byte 1 for an odd one
  data_id_of_counter,   ///< the entry of data_id_list for the value of the counter
  message_id,           ///< byte AddedByte::index of the CAN id; index 0 is the least significant byte
  length                ///< the number of bytes of the message
};

struct AddedByte {
  Source source = Source::constant;
  std::uint8_t value = 0;
  unsigned index = 0;  ///< 0..3; for data_id and message_id
  friend bool operator==(const AddedByte&, const AddedByte&) = default;
};

/// The kind of a sum.
enum class Addition : std::uint8_t { bytes, nibbles, xor_of_bytes, xor_of_nibbles };

/// A checksum that is a sum. It is computed in three steps: first the sum (or xor) of `start` and of all
/// bytes or nibbles; then, if `negated` is true, the two's complement; then the xor with final_xor. The place
/// may have fewer bits than the result; then only the lowest bits of the result are sent.
struct Sum {
  Addition addition = Addition::bytes;
  std::uint64_t start = 0;
  bool negated = false;
  std::uint64_t final_xor = 0;  ///< if all bits are 1, this is the one's complement
  friend bool operator==(const Sum&, const Sum&) = default;
};

/// A checksum covers, in this order: the bytes `before`, bytes of the message, the bytes `after`. The bits of
/// the checksum itself are taken as 0. Bytes of the message that contain only bits of the checksum are
/// skipped, unless own_bytes_as_zero is true.
struct Checksum {
  static constexpr std::size_t most_added = 16;  ///< largest size of `before`, and of `after`

  Place place;
  std::variant<Crc, Sum> rule;
  std::vector<unsigned> bytes;     ///< indices of the covered bytes of the message, in order; empty: all
  bool own_bytes_as_zero = false;  ///< true: bytes of the checksum are taken as 0 and not skipped
  std::vector<AddedByte> before;
  std::vector<AddedByte> after;
  friend bool operator==(const Checksum&, const Checksum&) = default;
};

/// A field with a constant value, such as the length of the message or a part of the data id.
struct Constant {
  Place place;
  std::uint64_t value = 0;
  friend bool operator==(const Constant&, const Constant&) = default;
};

/// The settings for one message. At least one of `counter` and `checksum` must have a value.
struct Settings {
  std::optional<Counter> counter;
  std::optional<Checksum> checksum;
  std::vector<Constant> constants;
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t>
      data_id_list;  ///< for Source::data_id_of_counter; an entry for each value below the modulo
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// A value for Checksum::bytes: the indices first..last, both included. Returns an error if they violate 0 <=
/// first <= last <= 63.
Result<std::vector<unsigned>> byte_range(std::int64_t first, std::int64_t last);

/// The message that is protected.
struct Subject {
  std::uint32_t id = 0;  ///< CAN id, 11 or 29 bits
  unsigned size = 0;     ///< number of bytes, 1..64
};

/// Returns an error of one line if the settings are impossible for the message. Reasons: a place is outside
/// the message or overlaps another place; a checksum covers itself; a counter is too large for its place; the
/// data id list has the wrong length; a CRC is invalid (see validate() in crc.hpp).
Result<void> validate(const Settings& settings, const Subject& subject);

/// The modulo of a counter. If Counter::modulo is 0, it is the number of values that fit the place. The place
/// must have 1..32 bits.
std::uint64_t modulo(const Counter& counter);

/// A mask of the bits of the field at `place`. The field must be inside the first 64 bytes.
std::array<std::uint8_t, Frame::max_size> bits_of(const Place& place);

/// Returns which bytes of a message a checksum covers. The result has the indices of these bytes, in the
/// order in which the checksum processes them. The message has `size` bytes.
std::vector<unsigned> covered_bytes(const Checksum& checksum, unsigned size);

/// The checksum for a value of the key `kind` in a file. The values are "crc4".."crc64" (a Crc of that width,
/// for which the polynomial must still be set), "sum", "nibble_sum", "xor" and "nibble_xor". The error lists
/// these values.
Result<std::variant<Crc, Sum>> checksum_kind(std::string_view word);

/// The added byte for a word in the list `before` or `after` of a file. The words are
/// "data_id_0".."data_id_3", "data_id_alternating", "data_id_of_counter", "message_id_0".."message_id_3" and
/// "length". The error lists these words.
Result<AddedByte> added_byte(std::string_view word);

}  // namespace canhil::protection
