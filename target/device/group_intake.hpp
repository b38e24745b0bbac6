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

/// Adds a frame that carries one Message of a group. True: the group is complete and must be read now. If the
/// frame begins a new group while the previous group is incomplete, the previous group is counted as dropped.
template <class Message, class Group>
bool completes(Group& group, const Frame& frame, std::uint8_t counter, Context& context) {
  const auto outcome = group.put(from_frame<Message>(frame), counter);
  if (outcome == Group::Outcome::dropped_previous) drop_group(context);
  return outcome == Group::Outcome::complete;
}

}  // namespace canhil::target
