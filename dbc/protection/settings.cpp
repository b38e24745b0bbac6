#include "dbc/protection/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <utility>

#include "dbc/protection/place.hpp"

namespace canhil::protection {
namespace {

constexpr std::array<std::pair<std::string_view, Addition>, 4> additions{
    {{"sum", Addition::bytes},
     {"nibble_sum", Addition::nibbles},
     {"xor", Addition::xor_of_bytes},
     {"nibble_xor", Addition::xor_of_nibbles}}};

constexpr std::array<std::pair<std::string_view, AddedByte>, 11> added_bytes{
    {{"data_id_0", {Source::data_id, 0, 0}},
     {"data_id_1", {Source::data_id, 0, 1}},
     {"data_id_2", {Source::data_id, 0, 2}},
     {"data_id_3", {Source::data_id, 0, 3}},
     {"data_id_alternating", {Source::data_id_alternating, 0, 0}},
     {"data_id_of_counter", {Source::data_id_of_counter, 0, 0}},
     {"message_id_0", {Source::message_id, 0, 0}},
     {"message_id_1", {Source::message_id, 0, 1}},
     {"message_id_2", {Source::message_id, 0, 2}},
     {"message_id_3", {Source::message_id, 0, 3}},
     {"length", {Source::length, 0, 0}}}};

/// The number N in a word "crcN"; nullopt: it is another word, or Crc does not support the width N.
std::optional<unsigned> crc_width(std::string_view word) {
  constexpr std::string_view crc = "crc";
  if (!word.starts_with(crc)) return std::nullopt;
  word.remove_prefix(crc.size());
  unsigned width = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), width);
  if (read.ec != std::errc{} || read.ptr != word.data() + word.size() || word.front() == '0')
    return std::nullopt;
  return width >= Crc::narrowest && width <= Crc::widest ? std::optional(width) : std::nullopt;
}

}  // namespace

Result<std::variant<Crc, Sum>> checksum_kind(std::string_view word) {
  using Rule = std::variant<Crc, Sum>;
  const auto sum = std::ranges::find(additions, word, &std::pair<std::string_view, Addition>::first);
  if (sum != additions.end()) return Rule(Sum{.addition = sum->second});
  if (const std::optional<unsigned> width = crc_width(word)) return Rule(Crc{.width = *width});
  return failure(
      fmt::format("checksum kind '{}', expected sum, nibble_sum, xor, nibble_xor or crcN with N = {}..{}",
                  word, Crc::narrowest, Crc::widest));
}

Result<AddedByte> added_byte(std::string_view word) {
  const auto found = std::ranges::find(added_bytes, word, &std::pair<std::string_view, AddedByte>::first);
  if (found != added_bytes.end()) return found->second;
  return failure(
      fmt::format("'{}' beside the data, expected data_id_0..data_id_3, data_id_alternating, "
                  "data_id_of_counter, message_id_0..message_id_3, length or a number 0..255",
                  word));
}

Result<std::vector<unsigned>> byte_range(std::int64_t first, std::int64_t last) {
  constexpr auto size = static_cast<std::int64_t>(Frame::max_size);
  if (first < 0 || last < first || last >= size)
    return failure(
        fmt::format("bytes {} to {}, expected the first and the last of 0..{}", first, last, size - 1));
  std::vector<unsigned> bytes(static_cast<std::size_t>(last - first + 1));
  std::iota(bytes.begin(), bytes.end(), static_cast<unsigned>(first));
  return bytes;
}

std::uint64_t modulo(const Counter& counter) {
  return counter.modulo != 0 ? counter.modulo : std::uint64_t{1} << counter.place.length;
}

std::array<std::uint8_t, Frame::max_size> bits_of(const Place& place) {
  std::array<std::uint8_t, Frame::max_size> bits{};
  for_each_bit(place, [&](unsigned byte, std::uint8_t bit, unsigned) { bits[byte] |= bit; });
  return bits;
}

std::vector<unsigned> covered_bytes(const Checksum& checksum, unsigned size) {
  std::vector<unsigned> bytes = checksum.bytes;
  if (bytes.empty()) {
    for (unsigned i = 0; i < size; ++i) bytes.push_back(i);
  }
  const auto own = bits_of(checksum.place);
  if (!checksum.own_bytes_as_zero) std::erase_if(bytes, [&](unsigned i) { return own[i] == 0xFF; });
  return bytes;
}

}  // namespace canhil::protection
