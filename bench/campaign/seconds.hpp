#pragma once

#include <cstdint>

namespace canhil::campaign {

/// A time [us] in seconds: the nearest double, so that 12.3 s prints as 12.3.
inline double seconds(std::int64_t t_us) { return static_cast<double>(t_us) / 1e6; }

}  // namespace canhil::campaign
