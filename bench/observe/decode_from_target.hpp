// Decodes messages of the target from received frames.
#pragma once

#include <optional>

#include "bench/nodes/is_whole.hpp"
#include "dbc/ports/port.hpp"
#include "dbc/wire/message.hpp"
#include "dbc/wire/routes.hpp"
#include "messages/canhil.hpp"

namespace canhil::observe {

/// The messages of the target.
inline constexpr Routes target_messages([](const MessageInfo& info) {
  return info.sender == messages::TargetHeartbeat::info.sender;
});

/// The message, if the frame is a valid one of this type and not an echo of the bench's own.
template <class Message>
std::optional<Message> decode_from_target(const Received& received) {
  if (received.own || !nodes::is_whole<Message>(received.frame)) return std::nullopt;
  return from_frame<Message>(received.frame);
}

}  // namespace canhil::observe
