// Converts generated messages to protected frames, and frames to messages.
#pragma once

#include "dbc/wire/e2e.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil {

/// Packs a generated message into a frame; the signals are rounded and saturated. If the message has an E2E
/// data id, the frame is protected with the given counter (0..14). With Rounding::none, the scaled signals
/// are also appended to the packed bytes as doubles.
template <class Message>
Frame to_frame(const Message& message, std::uint8_t counter, Rounding rounding = Rounding::as_on_the_bus) {
  Frame frame;
  frame.id = Message::info.id;
  frame.extended = Message::info.extended;
  frame.fd = Message::info.fd;
  frame.brs = Message::info.fd;
  frame.size = Message::size;
  message.pack(std::span<std::uint8_t, Message::size>(frame.data.data(), Message::size));
  if constexpr (Message::info.e2e_data_id != 0)
    e2e::protect({frame.data.data(), Message::size}, Message::info.e2e_data_id, counter);
  if (rounding == Rounding::none) [[unlikely]]
    wire::carry_unrounded(&message, Message::scaled(), frame);
  return frame;
}

/// Unpacks a frame, which must have the id and the size of the message. Ignores the E2E fields.
template <class Message>
Message from_frame(const Frame& frame) {
  Message message =
      Message::unpack(std::span<const std::uint8_t, Message::size>(frame.data.data(), Message::size));
  if (frame.unrounded) [[unlikely]]
    wire::take_unrounded(frame, Message::scaled(), &message);
  return message;
}

}  // namespace canhil
