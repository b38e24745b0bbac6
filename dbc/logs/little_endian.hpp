// Little-endian numbers in the bytes of a binary log.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace canhil::logs {

static_assert(std::endian::native == std::endian::little);

/// The number at an offset, which must lie inside with all of its bytes.
template <class Number>
Number little_endian(std::span<const std::uint8_t> bytes, std::size_t offset) {
  Number value{};
  std::memcpy(&value, bytes.subspan(offset, sizeof value).data(), sizeof value);
  return value;
}

/// Appends a number.
template <class Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace canhil::logs
