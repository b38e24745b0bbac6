// Decodes messages of the target from received frames.
#pragma once

#include <optional>

#include "bench/nodes/is_whole.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/wire/message.hpp"
#include "dbc/wire/routes.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {

/// The messages of the target.
inline constexpr Routes target_messages(is_targets);

/// The message in a frame; none: the frame is not a valid message of this type, or is an echo of a frame that
/// the bench sent.
template <class Message>
std::optional<Message> decode_from_target(const Received& received) {
  if (received.own || !nodes::is_whole<Message>(received.frame)) return std::nullopt;
  return from_frame<Message>(received.frame);
}

}  // namespace canhil::protocol
