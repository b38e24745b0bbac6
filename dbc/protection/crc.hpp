// Cyclic redundancy checks (CRCs) whose parameters are known only at run time. The parameters are those of
// the "Rocksoft" model, which describes the published CRCs (Williams, A Painless Guide to CRC Error Detection
// Algorithms, 1993).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dbc/wire/result.hpp"

namespace canhil::protection {

/// The parameters of a CRC. `polynomial` does not contain the highest term. The members polynomial, start and
/// final_xor have `width` bits. Their most significant bit belongs to the highest power of x, also for a
/// reflected CRC.
struct Crc {
  static constexpr unsigned narrowest = 4;
  static constexpr unsigned widest = 64;

  unsigned width = 8;
  std::uint64_t polynomial = 0;
  std::uint64_t start = 0;
  bool input_reflected = false;   ///< the least significant bit of each byte is processed first
  bool output_reflected = false;  ///< the result is mirrored before final_xor is applied
  std::uint64_t final_xor = 0;

  friend bool operator==(const Crc&, const Crc&) = default;
};

/// A published CRC. `check` is its published result for the nine bytes "123456789".
struct PublishedCrc {
  std::string_view name;
  Crc crc;
  std::uint64_t check = 0;
};

/// All published CRCs that have a name in this program, sorted by width.
std::span<const PublishedCrc> published_crcs();

/// The published CRC with this name, such as "CRC-8/SAE-J1850". The error lists all names.
Result<Crc> published_crc(std::string_view name);

/// Returns an error of one line if a parameter is impossible: the width is not 4..64; the polynomial is even;
/// or a value is wider than the CRC. If the polynomial were even, one bit of the CRC would be constant. A
/// polynomial in reflected notation is usually even.
Result<void> validate(const Crc& crc);

/// The CRC of the bytes, right-aligned. `crc` must be valid.
std::uint64_t compute(const Crc& crc, std::span<const std::uint8_t> bytes);

}  // namespace canhil::protection
