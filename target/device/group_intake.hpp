// Frames into sample groups, with what is lost on the way counted.
#pragma once

#include <cstdint>

#include "dbc/wire/sample_group.hpp"
#include "target/device/adapter.hpp"

namespace canhil::target {

/// Counts a group that is not used.
inline void drop_group(Context& context) {
  ++context.losses.bad_group;
  context.errors.input_lost = true;
}

/// Puts a frame of a group's Message; true: the group is whole, read it now. An incomplete one before it is
/// counted as dropped.
template <class Message, class Group>
bool completes(Group& group, const Frame& frame, std::uint8_t counter, Context& context) {
  const auto outcome = group.put(from_frame<Message>(frame), counter);
  if (outcome == Group::Outcome::dropped_previous) drop_group(context);
  return outcome == Group::Outcome::complete;
}

}  // namespace canhil::target
