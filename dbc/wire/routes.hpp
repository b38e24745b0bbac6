// Finds the message of a frame by the id of the frame, with one look-up.
#pragma once

#include <array>
#include <cstdint>

#include "dbc/wire/message.hpp"
#include "messages/canhil.hpp"

namespace canhil {

/// The messages that a receiver reads. They are found by their standard ids.
class Routes {
 public:
  static constexpr std::size_t nowhere = 0xFF;

  /// Selects the messages for which `wanted(const MessageInfo&)` returns true.
  template <class Wanted>
  consteval explicit Routes(Wanted wanted) {
    index_.fill(nowhere);
    for (std::size_t i = 0; i < messages::all_messages.size(); ++i) {
      const MessageInfo& info = messages::all_messages[i];
      if (!info.extended && wanted(info)) index_[info.id] = static_cast<std::uint8_t>(i);
    }
  }

  /// The index of a frame's message in all_messages; nowhere for error frames, extended ids and ids that are
  /// not selected.
  [[nodiscard]] constexpr std::size_t operator()(const Frame& frame) const {
    return frame.error || frame.extended || frame.id >= index_.size() ? nowhere : index_[frame.id];
  }

 private:
  static_assert(messages::all_messages.size() < nowhere);
  std::array<std::uint8_t, 2048> index_{};
};

}  // namespace canhil
