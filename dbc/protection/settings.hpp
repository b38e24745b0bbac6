// What protects a message, as plain values: a counter, a checksum, fields with a constant value. Written by a
// profile (profiles.hpp) or from a file; protection.hpp turns valid ones into a Protection.
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

/// Where a field lies in a message, as a DBC writes it.
struct Place {
  unsigned start_bit = 0;   ///< of the least (Intel) or the most (Motorola) significant bit
  unsigned length = 0;      ///< bits, 1..64
  bool big_endian = false;  ///< Motorola
  friend bool operator==(const Place&, const Place&) = default;
};

/// A counter that goes up by one with each frame: 0..modulo - 1 without the skipped values, then over again.
struct Counter {
  Place place;
  std::uint64_t modulo = 0;            ///< 0: as many values as the place holds
  std::vector<std::uint64_t> skipped;  ///< values below the modulo that are never sent
  std::string shared_as;  ///< messages with the same name share one counter; empty: a counter of its own
};

/// Where a byte comes from that a checksum covers in addition to the message's bytes.
enum class Source : std::uint8_t {
  constant,             ///< AddedByte::value
  data_id,              ///< byte AddedByte::index of the data id, 0: the least significant
  data_id_alternating,  ///< byte 0 of the data id for an even counter, byte 1 for an odd one
  data_id_of_counter,   ///< the entry of the data id list at the counter's value
  message_id,           ///< byte AddedByte::index of the CAN id, 0: the least significant
  length                ///< the message's bytes
};

struct AddedByte {
  Source source = Source::constant;
  std::uint8_t value = 0;
  unsigned index = 0;  ///< 0..3
  friend bool operator==(const AddedByte&, const AddedByte&) = default;
};

/// What a sum adds up.
enum class Addition : std::uint8_t { bytes, nibbles, xor_of_bytes, xor_of_nibbles };

/// start plus all bytes or nibbles (or their xor), then the two's complement if `negated`, then xor with
/// final_xor. The lowest bits, as many as the place holds, are sent.
struct Sum {
  Addition addition = Addition::bytes;
  std::uint64_t start = 0;
  bool negated = false;
  std::uint64_t final_xor = 0;  ///< all ones: the result's complement
  friend bool operator==(const Sum&, const Sum&) = default;
};

/// A checksum covers, in this order: `before`, the message's bytes, `after`. Bits of the checksum itself
/// count as 0; bytes that hold nothing else are left out.
struct Checksum {
  static constexpr std::size_t most_added = 16;  ///< of before and of after

  Place place;
  std::variant<Crc, Sum> rule;
  std::vector<unsigned> bytes;     ///< the bytes covered, in their order; empty: all
  bool own_bytes_as_zero = false;  ///< covers the bytes of the checksum as 0 in place of leaving them out
  std::vector<AddedByte> before;
  std::vector<AddedByte> after;
};

/// A field that always has this value: a length, a part of the data id.
struct Constant {
  Place place;
  std::uint64_t value = 0;
};

/// How one message is protected; at least a counter or a checksum is needed.
struct Settings {
  std::optional<Counter> counter;
  std::optional<Checksum> checksum;
  std::vector<Constant> constants;
  std::uint32_t data_id = 0;
  std::vector<std::uint8_t>
      data_id_list;  ///< for Source::data_id_of_counter: an entry for each value below the modulo
};

/// The bytes first..last, both included, for Checksum::bytes. Error if they are not in 0..63 and in this
/// order.
Result<std::vector<unsigned>> byte_range(std::int64_t first, std::int64_t last);

/// The message that is protected.
struct Subject {
  std::uint32_t id = 0;  ///< CAN id, 11 or 29 bits
  unsigned size = 0;     ///< bytes, 1..64
};

/// An error in one line if the settings are impossible for a message: a place beyond it or over another one,
/// a checksum over itself, a counter that its place cannot hold, a data id list that does not fit, a CRC that
/// cannot be (validate(Crc)).
Result<void> validate(const Settings& settings, const Subject& subject);

/// The counter's modulo, from its place where none is given. The place must have 1..32 bits.
std::uint64_t modulo(const Counter& counter);

/// The bits of a field, byte by byte. The place must lie in 64 bytes.
std::array<std::uint8_t, Frame::max_size> bits_of(const Place& place);

/// The bytes that a checksum covers of a message of `size` bytes, in their order.
std::vector<unsigned> covered_bytes(const Checksum& checksum, unsigned size);

/// The rule that a file's word `kind` means: "crc4".."crc64" (a Crc of that width, without polynomial),
/// "sum", "nibble_sum", "xor", "nibble_xor". The error lists the words.
Result<std::variant<Crc, Sum>> checksum_kind(std::string_view word);

/// The byte that a file's word in `before` or `after` means: "data_id_0".."data_id_3", "data_id_alternating",
/// "data_id_of_counter", "message_id_0".."message_id_3", "length". The error lists the words.
Result<AddedByte> added_byte(std::string_view word);

}  // namespace canhil::protection
