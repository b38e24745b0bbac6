// Bus arbitration.
#pragma once

#include <cstdint>

namespace canhil::wire {

/// The rank of a frame when several start at once: the smallest number wins. If base ids are equal, an 11-bit
/// id wins against a 29-bit one (its RTR and IDE bits are dominant, the other's SRR and IDE are recessive).
constexpr std::uint32_t arbitration_rank(std::uint32_t id, bool extended) {
  return extended ? (id >> 18U) << 19U | 1U << 18U | (id & 0x3FFFFU) : id << 19U;
}

}  // namespace canhil::wire
