// Frames without rounding. They exist only inside one process: the frame contains the packed bytes of the
// message and, behind them, its scaled signals as doubles. If a run with such frames is compared with a
// normal run, the difference shows the effect of rounding the signals for the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "dbc/wire/frame.hpp"

namespace canhil {

/// How scaled signals are rounded when they are packed.
enum class Rounding : std::uint8_t {
  as_on_the_bus,  ///< rounded to the steps that the DBC defines
  none            ///< not rounded; only inside one process, because no bus carries such frames
};

namespace wire {

/// A member of a message struct that packing rounds.
struct ScaledMember {
  std::size_t offset = 0;  ///< offset of the member in the struct; the member is a double
  /// The limits of the physical value. The value saturates to them, as on the bus.
  double lowest = 0;
  double highest = 0;
};

/// Appends the values of the members to a frame that contains the packed message. The values are saturated;
/// NaN becomes the lowest value.
void carry_unrounded(const void* message, std::span<const ScaledMember> members, Frame& frame);

/// Replaces the members of an unpacked message by the values that carry_unrounded() appended to the frame.
void take_unrounded(const Frame& frame, std::span<const ScaledMember> members, void* message);

}  // namespace wire
}  // namespace canhil
