// Converts bytes of a frame to 64-bit words and back, and extracts signals. Each function compiles to a few
// instructions: a load, shifts and a store.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace canhil::wire {

static_assert(std::endian::native == std::endian::little, "canhil is written for little-endian hosts");

/// The position of bit i of a signal in the message: byte * 8 + the bit in this byte (0: least significant).
/// Bit i = 0 is the start bit of the DBC. For Intel, this is the least significant bit of the signal, and
/// larger i mean more significant bits. For Motorola, this is the most significant bit of the signal, and
/// larger i mean less significant bits.
constexpr unsigned bit_position(unsigned start_bit, unsigned i, bool big_endian) {
  if (!big_endian) return start_bit + i;
  const unsigned sequential = (start_bit / 8) * 8 + (7 - start_bit % 8) + i;
  return (sequential / 8) * 8 + (7 - sequential % 8);
}

/// Returns `bytes` bytes, from byte `first`, as one number. The first byte is the least significant one.
template <std::size_t first, std::size_t bytes>
constexpr std::uint64_t load_le(const std::uint8_t* data) {
  static_assert(bytes <= 8);
  std::uint64_t word = 0;
  if (std::is_constant_evaluated()) {
    for (std::size_t i = 0; i < bytes; ++i) word |= std::uint64_t{data[first + i]} << (8 * i);
  } else if constexpr (bytes > 0) {
    std::memcpy(&word, data + first, bytes);
  }
  return word;
}

/// Returns `bytes` bytes, from byte `first`, as one number. The first byte is the most significant one.
template <std::size_t first, std::size_t bytes>
constexpr std::uint64_t load_be(const std::uint8_t* data) {
  return bytes == 0 ? 0 : __builtin_bswap64(load_le<first, bytes>(data)) >> ((64 - 8 * bytes) & 63);
}

/// The inverse of load_le().
template <std::size_t first, std::size_t bytes>
constexpr void store_le(std::uint8_t* data, std::uint64_t word) {
  static_assert(bytes <= 8);
  if (std::is_constant_evaluated()) {
    for (std::size_t i = 0; i < bytes; ++i) data[first + i] = static_cast<std::uint8_t>(word >> (8 * i));
  } else if constexpr (bytes > 0) {
    std::memcpy(data + first, &word, bytes);
  }
}

/// The inverse of load_be().
template <std::size_t first, std::size_t bytes>
constexpr void store_be(std::uint8_t* data, std::uint64_t word) {
  if constexpr (bytes > 0) store_le<first, bytes>(data, __builtin_bswap64(word) >> (64 - 8 * bytes));
}

/// Sets those bits of the bytes that are 1 in the word (bitwise or).
template <std::size_t first, std::size_t bytes>
constexpr void merge_le(std::uint8_t* data, std::uint64_t word) {
  store_le<first, bytes>(data, load_le<first, bytes>(data) | word);
}
/// Like merge_le(), but the first byte is the most significant one.
template <std::size_t first, std::size_t bytes>
constexpr void merge_be(std::uint8_t* data, std::uint64_t word) {
  store_be<first, bytes>(data, load_be<first, bytes>(data) | word);
}

/// A word whose lowest `length` bits are 1.
constexpr std::uint64_t mask(unsigned length) {
  return length >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << length) - 1;
}

/// Returns the `length` bits of a word from bit `shift` upwards, as an unsigned number.
template <unsigned shift, unsigned length>
constexpr std::uint64_t unsigned_bits(std::uint64_t word) {
  static_assert(length > 0 && shift + length <= 64);
  return (word >> shift) & mask(length);
}

/// Returns the `length` bits of a word from bit `shift` upwards, as a signed number (two's complement).
template <unsigned shift, unsigned length>
constexpr std::int64_t signed_bits(std::uint64_t word) {
  static_assert(length > 0 && shift + length <= 64);
  return static_cast<std::int64_t>(word << (64 - shift - length)) >> (64 - length);
}

/// Returns the lowest `length` bits of `raw`, shifted left by `shift`.
template <unsigned shift, unsigned length>
constexpr std::uint64_t placed(std::uint64_t raw) {
  static_assert(length > 0 && shift + length <= 64);
  return (raw & mask(length)) << shift;
}

}  // namespace canhil::wire
