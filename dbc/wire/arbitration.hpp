// Who wins the bus.
#pragma once

#include <cstdint>

namespace canhil::wire {

/// How frames rank where several begin at once: the smaller number wins. Where base ids are equal, the 11-bit
/// id wins over the 29-bit one (RTR and IDE are dominant where SRR and IDE are not).
constexpr std::uint32_t arbitration_rank(std::uint32_t id, bool extended) {
  return extended ? (id >> 18U) << 19U | 1U << 18U | (id & 0x3FFFFU) : id << 19U;
}

}  // namespace canhil::wire
