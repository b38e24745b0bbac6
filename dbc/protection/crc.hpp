// Cyclic redundancy checks with parameters known only at run time, in the "Rocksoft" model that describes the
// published CRCs (Williams, A Painless Guide to CRC Error Detection Algorithms, 1993).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// A CRC. The polynomial omits its highest term. Polynomial, start and final_xor have `width` bits and are
/// written most significant bit first, also for a reflected CRC.
struct Crc {
  static constexpr unsigned narrowest = 4;
  static constexpr unsigned widest = 64;

  unsigned width = 8;
  std::uint64_t polynomial = 0;
  std::uint64_t start = 0;
  bool input_reflected = false;   ///< each byte enters with its least significant bit first
  bool output_reflected = false;  ///< the result is mirrored, before final_xor
  std::uint64_t final_xor = 0;

  friend bool operator==(const Crc&, const Crc&) = default;
};

/// A published CRC, with its published result for the nine bytes "123456789".
struct PublishedCrc {
  std::string_view name;
  Crc crc;
  std::uint64_t check = 0;
};

/// All published CRCs with a name, ordered by width.
std::span<const PublishedCrc> published_crcs();

/// The published CRC with a name such as "CRC-8/SAE-J1850". The error lists the names.
Result<Crc> published_crc(std::string_view name);

/// Error: one line if a value is impossible: a width outside 4..64, an even polynomial (one bit of the CRC
/// would be constant; a polynomial in reflected notation is usually even), or a value wider than the CRC.
Result<void> validate(const Crc& crc);

/// The CRC of the bytes, right-aligned. The model must be valid.
std::uint64_t compute(const Crc& crc, std::span<const std::uint8_t> bytes);

}  // namespace canhil::protection
