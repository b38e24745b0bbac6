// Assembles frames into sample groups and counts losses.
#pragma once

#include <cstdint>

#include "dbc/wire/sample_group.hpp"
#include "target/device/adapter.hpp"

namespace canhil::target {

/// Counts a discarded group.
inline void drop_group(Context& context) {
  ++context.losses.bad_group;
  context.errors.input_lost = true;
}

/// Adds a frame with one Message of a group; true: the group is complete, read it now. Counts an incomplete
/// previous group as dropped.
template <class Message, class Group>
bool completes(Group& group, const Frame& frame, std::uint8_t counter, Context& context) {
  const auto outcome = group.put(from_frame<Message>(frame), counter);
  if (outcome == Group::Outcome::dropped_previous) drop_group(context);
  return outcome == Group::Outcome::complete;
}

}  // namespace canhil::target
