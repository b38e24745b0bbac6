// Date and time of day of this machine's time zone. The formats of Vector and PEAK state no time zone.
#pragma once

#include <cstdint>
#include <ctime>

namespace canhil::logs {

/// Seconds since 1970 (UTC) of a local time. `when` may have any daylight saving time flag; it is determined.
inline std::int64_t since_1970_s(std::tm when) {
  when.tm_isdst = -1;
  return std::mktime(&when);
}

/// The local time of a number of seconds since 1970 (UTC).
inline std::tm local_time(std::int64_t s) {
  std::tm when{};
  const std::time_t time = s;
  ::localtime_r(&time, &when);
  return when;
}

}  // namespace canhil::logs
