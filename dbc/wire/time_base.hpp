// Converts times of the bench's time base to the times in messages, and back. Most messages have times of 32
// bits, which count microseconds and wrap every 71.6 minutes. Samples that must fit into one frame have times
// of 16 bits, which count units of 10 us and wrap every 655.36 ms.
#pragma once

#include <cstdint>

namespace canhil {

/// Of all times [us] whose low 32 bits are `low_us`, returns the time nearest to `reference_us`. The result
/// is right if the true time is within 35 minutes of the reference.
constexpr std::int64_t unwrap_us(std::uint32_t low_us, std::int64_t reference_us) {
  const auto difference = static_cast<std::int32_t>(low_us - static_cast<std::uint32_t>(reference_us));
  return reference_us + difference;
}

/// The low 32 bits of a time [us] of the bench's time base.
constexpr std::uint32_t wrap_us(std::int64_t t_us) { return static_cast<std::uint32_t>(t_us); }

/// The time [us] after which times with 16 bits in units of 10 us wrap.
inline constexpr std::int64_t short_period_us = std::int64_t{65'536} * 10;

/// Of all times [us] that equal `short_us` modulo short_period_us, returns the latest one that is not after
/// `latest_us`. The result is right if the true time is not after latest_us and at most 0.65 s before it.
constexpr std::int64_t unwrap_short_us(std::int64_t short_us, std::int64_t latest_us) {
  const std::int64_t age_us = (latest_us - short_us) % short_period_us;
  return latest_us - (age_us < 0 ? age_us + short_period_us : age_us);
}

/// Reduces a time [us] of the bench's time base modulo short_period_us.
constexpr std::int64_t wrap_short_us(std::int64_t t_us) {
  const std::int64_t rest_us = t_us % short_period_us;
  return rest_us < 0 ? rest_us + short_period_us : rest_us;
}

}  // namespace canhil
