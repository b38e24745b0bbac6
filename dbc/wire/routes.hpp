// From a frame's id to its message in one look-up.
#pragma once

#include <array>
#include <cstdint>

#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil {

/// Which of the bus's messages a receiver listens to, by standard id.
class Routes {
 public:
  static constexpr std::size_t nowhere = 0xFF;

  /// Listens to the messages that `wanted(const MessageInfo&)` holds for.
  template <class Wanted>
  consteval explicit Routes(Wanted wanted) {
    place_.fill(nowhere);
    for (std::size_t i = 0; i < messages::all_messages.size(); ++i) {
      const MessageInfo& info = messages::all_messages[i];
      if (!info.extended && wanted(info)) place_[info.id] = static_cast<std::uint8_t>(i);
    }
  }

  /// The place of a frame's message in all_messages, or nowhere: error frames, extended ids, ids not listened
  /// to.
  [[nodiscard]] constexpr std::size_t operator()(const Frame& frame) const {
    return frame.error || frame.extended || frame.id >= place_.size() ? nowhere : place_[frame.id];
  }

 private:
  static_assert(messages::all_messages.size() < nowhere);
  std::array<std::uint8_t, 2048> place_{};
};

}  // namespace canhil
