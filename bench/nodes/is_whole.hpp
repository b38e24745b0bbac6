// Whether a frame is a valid message of canhil's DBC.
#pragma once

#include "dbc/wire/message.hpp"

namespace canhil::nodes {

/// Checks id, size, CRC and counter range. An error frame is never valid, although its error-class bits may
/// equal a message's id.
template <class Message>
bool is_whole(const Frame& frame) {
  return frame.id == Message::info.id && !frame.error && frame.extended == Message::info.extended &&
         frame.size == Message::size &&
         frame.data[0] == e2e::crc(frame.payload(), Message::info.e2e_data_id) &&
         e2e::counter(frame.payload()) < e2e::counter_period;
}

}  // namespace canhil::nodes
