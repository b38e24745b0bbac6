// Frames that round nothing: between two ends in one process the scaled signals of a message travel beside
// its packed bytes, as doubles. What a run loses by the resolution of the bus shows by comparison.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// What becomes of scaled signals on the way.
enum class Rounding : std::uint8_t {
  as_on_the_bus,  ///< to the steps that the DBC gives them
  none            ///< nothing; possible in one process only, no bus carries such frames
};

namespace wire {

/// A member of a message that packing rounds.
struct ScaledMember {
  std::size_t offset = 0;  ///< in the message's struct; the member is a double
  double lowest = 0;       ///< physical range, to which it saturates as on the bus
  double highest = 0;
};

/// Appends the members to a frame that holds the packed message: saturated, NaN as the lowest value.
void carry_unrounded(const void* message, std::span<const ScaledMember> members, Frame& frame);

/// Replaces the members of an unpacked message by what carry_unrounded() appended.
void take_unrounded(const Frame& frame, std::span<const ScaledMember> members, void* message);

}  // namespace wire
}  // namespace canhil
