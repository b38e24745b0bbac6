// Frames without rounding: within one process the scaled signals of a message travel as doubles behind its
// packed bytes. Comparing such a run with a normal one shows the effect of the bus's resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// How scaled signals are rounded in transmission.
enum class Rounding : std::uint8_t {
  as_on_the_bus,  ///< to the steps of the DBC
  none            ///< not at all; only within one process, as no bus carries such frames
};

namespace wire {

/// A member of a message that packing rounds.
struct ScaledMember {
  std::size_t offset = 0;  ///< in the message's struct; the member is a double
  double lowest = 0;  ///< lowest to highest: the physical range, to which the value saturates as on the bus
  double highest = 0;
};

/// Appends the members to a frame with the packed message: saturated, NaN as the lowest value.
void carry_unrounded(const void* message, std::span<const ScaledMember> members, Frame& frame);

/// Replaces the members of an unpacked message by the values that carry_unrounded() appended.
void take_unrounded(const Frame& frame, std::span<const ScaledMember> members, void* message);

}  // namespace wire
}  // namespace canhil
