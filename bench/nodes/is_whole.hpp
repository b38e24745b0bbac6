// Whether a frame is a message of the contract as its sender made it.
#pragma once

#include "dbc/wire/message.hpp"

namespace canhil::nodes {

/// Its id, size, CRC and a counter that protection uses; an error frame, whose class bits may look like any
/// id, is none.
template <class Message>
bool is_whole(const Frame& frame) {
  return frame.id == Message::info.id && !frame.error && frame.extended == Message::info.extended &&
         frame.size == Message::size &&
         frame.data[0] == e2e::crc(frame.payload(), Message::info.e2e_data_id) &&
         e2e::counter(frame.payload()) < e2e::counter_period;
}

}  // namespace canhil::nodes
