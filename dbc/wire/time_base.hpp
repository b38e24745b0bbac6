// The bench's time base in 32 bits: microseconds that wrap every 71.6 minutes. A sample that must fit into
// one frame uses 16 bits in units of 10 us, which wrap every 655.36 ms.
#pragma once

#include <cstdint>

namespace canhil {

/// The full time [us] nearest to `reference_us` whose low 32 bits are `low_us`. Correct within 35 minutes of
/// the reference.
constexpr std::int64_t unwrap_us(std::uint32_t low_us, std::int64_t reference_us) {
  const auto difference = static_cast<std::int32_t>(low_us - static_cast<std::uint32_t>(reference_us));
  return reference_us + difference;
}

/// The low 32 bits of a time [us] of the bench's time base.
constexpr std::uint32_t wrap_us(std::int64_t t_us) { return static_cast<std::uint32_t>(t_us); }

/// The period [us] of times in 16 bits of 10 us.
inline constexpr std::int64_t short_period_us = 65536 * 10;

/// The latest time [us] up to `latest_us` that equals `short_us` modulo short_period_us. Correct for times
/// within 0.65 s before latest_us.
constexpr std::int64_t unwrap_short_us(std::int64_t short_us, std::int64_t latest_us) {
  const std::int64_t age_us = (latest_us - short_us) % short_period_us;
  return latest_us - (age_us < 0 ? age_us + short_period_us : age_us);
}

/// A time [us] of the bench's time base modulo short_period_us.
constexpr std::int64_t wrap_short_us(std::int64_t t_us) {
  const std::int64_t rest_us = t_us % short_period_us;
  return rest_us < 0 ? rest_us + short_period_us : rest_us;
}

}  // namespace canhil
