// The bench's time base in 32 bits: microseconds that wrap every 71.6 minutes.
#pragma once

#include <cstdint>

namespace canhil {

/// The full time [us] nearest to `reference_us` whose low 32 bits are `low_us`. Right within +-35 minutes of
/// it.
constexpr std::int64_t unwrap_us(std::uint32_t low_us, std::int64_t reference_us) {
  const auto difference = static_cast<std::int32_t>(low_us - static_cast<std::uint32_t>(reference_us));
  return reference_us + difference;
}

/// The low 32 bits of a time [us] of the bench's time base.
constexpr std::uint32_t wrap_us(std::int64_t t_us) { return static_cast<std::uint32_t>(t_us); }

}  // namespace canhil
