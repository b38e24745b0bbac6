#pragma once

#include <cstdint>

namespace canhil::campaign {

/// Converts a time from us to s. The result is the nearest double, so 12.3 s is printed as 12.3.
inline double seconds(std::int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

}  // namespace canhil::campaign
