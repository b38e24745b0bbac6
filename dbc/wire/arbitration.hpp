// The priority of frames in the arbitration on the bus.
#pragma once

#include <cstdint>

namespace canhil::wire {

/// The rank of a frame in the arbitration: of several frames that start at the same time, the frame with the
/// smallest rank is sent. If the base ids are equal, a frame with an 11-bit id has priority over one with a
/// 29-bit id: the bits RTR and IDE of the former are dominant, the bits SRR and IDE of the latter are
/// recessive.
constexpr std::uint32_t arbitration_rank(std::uint32_t id, bool extended) {
  return extended ? (id >> 18U) << 19U | 1U << 18U | (id & 0x3FFFFU) : id << 19U;
}

}  // namespace canhil::wire
