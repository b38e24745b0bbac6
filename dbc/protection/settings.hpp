// The protection of a message as plain values: counter, checksum, fields with a constant value. Settings
// come from a profile (profiles.hpp) or a file; protection.hpp turns valid settings into a Protection.
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
  unsigned start_bit = 0;   ///< of the least (Intel) or the most (Motorola) significant bit
  unsigned length = 0;      ///< bits, 1..64
  bool big_endian = false;  ///< Motorola
  friend bool operator==(const Place&, const Place&) = default;
};

/// A counter that increases by one with each frame: 0..modulo - 1 without the skipped values, then from 0
/// again.
struct Counter {
  Place place;
  std::uint64_t modulo = 0;            ///< 0: all values that fit the place
  std::vector<std::uint64_t> skipped;  ///< values below the modulo that are never sent
  std::string shared_as;  ///< messages with the same name here share one counter; empty: not shared
};

/// The source of a byte that a checksum covers in addition to the message's bytes.
enum class Source : std::uint8_t {
  constant,             ///< AddedByte::value
  data_id,              ///< byte AddedByte::index of the data id; 0: the least significant
  data_id_alternating,  ///< byte 0 of the data id for an even counter, byte 1 for an odd one
  data_id_of_counter,   ///< the data id list's entry for the counter's value
  message_id,           ///< byte AddedByte::index of the CAN id; 0: the least significant
  length                ///< the number of bytes of the message
};

struct AddedByte {
  Source source = Source::constant;
  std::uint8_t value = 0;
  unsigned index = 0;  ///< 0..3
  friend bool operator==(const AddedByte&, const AddedByte&) = default;
};

/// The operation of a sum.
enum class Addition : std::uint8_t { bytes, nibbles, xor_of_bytes, xor_of_nibbles };

/// The sum (or xor) of start and all bytes or nibbles, then the two's complement if `negated`, then xor with
/// final_xor. The lowest bits that fit the place are sent.
struct Sum {
  Addition addition = Addition::bytes;
  std::uint64_t start = 0;
  bool negated = false;
  std::uint64_t final_xor = 0;  ///< all ones: one's complement of the result
  friend bool operator==(const Sum&, const Sum&) = default;
};

/// A checksum covers, in this order: `before`, the message's bytes, `after`. Bits of the checksum itself
/// count as 0; bytes that contain only checksum bits are skipped.
struct Checksum {
  static constexpr std::size_t most_added = 16;  ///< for each of `before` and `after`

  Place place;
  std::variant<Crc, Sum> rule;
  std::vector<unsigned> bytes;     ///< the bytes covered, in their order; empty: all
  bool own_bytes_as_zero = false;  ///< covers the checksum's bytes as 0 instead of skipping them
  std::vector<AddedByte> before;
  std::vector<AddedByte> after;
};

/// A field with a constant value: a length, a part of the data id.
struct Constant {
  Place place;
  std::uint64_t value = 0;
};

/// The protection of one message; needs a counter or a checksum or both.
struct Settings {
  std::optional<Counter> counter;
  std::optional<Checksum> checksum;
  std::vector<Constant> constants;
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t>
      data_id_list;  ///< for Source::data_id_of_counter: an entry for each value below the modulo
};

/// The bytes first..last, both included, for Checksum::bytes. Error unless 0 <= first <= last <= 63.
Result<std::vector<unsigned>> byte_range(std::int64_t first, std::int64_t last);

/// The message that is protected.
struct Subject {
  std::uint32_t id = 0;  ///< CAN id, 11 or 29 bits
  unsigned size = 0;     ///< bytes, 1..64
};

/// Error: one line if the settings are impossible for the message: a place outside the message or overlapping
/// another one, a checksum over itself, a counter too large for its place, a data id list of the wrong
/// length, an invalid CRC (validate(Crc)).
Result<void> validate(const Settings& settings, const Subject& subject);

/// The counter's modulo; by default the number of values that fit the place. The place must have 1..32 bits.
std::uint64_t modulo(const Counter& counter);

/// A mask of the field's bits. The place must lie within 64 bytes.
std::array<std::uint8_t, Frame::max_size> bits_of(const Place& place);

/// The bytes that a checksum covers of a message of `size` bytes, in their order.
std::vector<unsigned> covered_bytes(const Checksum& checksum, unsigned size);

/// The rule for the value of the key `kind` in a file: "crc4".."crc64" (a Crc of that width, no polynomial),
/// "sum", "nibble_sum", "xor", "nibble_xor". The error lists the words.
Result<std::variant<Crc, Sum>> checksum_kind(std::string_view word);

/// The byte for a word of `before` or `after` in a file: "data_id_0".."data_id_3", "data_id_alternating",
/// "data_id_of_counter", "message_id_0".."message_id_3", "length". The error lists the words.
Result<AddedByte> added_byte(std::string_view word);

}  // namespace canhil::protection
