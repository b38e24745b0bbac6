// Software version of the target, for the heartbeat.
#pragma once

#include <cstdint>

namespace canhil::target {

inline constexpr std::uint8_t version_major = 0;
inline constexpr std::uint8_t version_minor = 1;

}  // namespace canhil::target
