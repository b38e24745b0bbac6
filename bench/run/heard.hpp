// One message of the target in what the bus gave.
#pragma once

#include <optional>

#include "dbc/ports/port.hpp"
#include "dbc/wire/message.hpp"

namespace canhil::run {

/// The message, if this is one and whole: no echo of ours, no error frame (its class bits may look like any
/// id), right size and CRC.
template <class Message>
std::optional<Message> heard(const Received& received) {
  const Frame& frame = received.frame;
  if (received.own || frame.error || frame.extended != Message::info.extended ||
      frame.id != Message::info.id || frame.size != Message::size ||
      frame.data[0] != e2e::crc(frame.payload(), Message::info.e2e_data_id)) {
    return std::nullopt;
  }
  return from_frame<Message>(frame);
}

}  // namespace canhil::run
