// One message of the target in what the bus gave.
#pragma once

#include <optional>

#include "bench/nodes/is_whole.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/wire/message.hpp"

namespace canhil::run {

/// The message, if this is one and whole, and no echo of ours.
template <class Message>
std::optional<Message> heard(const Received& received) {
  if (received.own || !nodes::is_whole<Message>(received.frame)) return std::nullopt;
  return from_frame<Message>(received.frame);
}

}  // namespace canhil::run
