// Finds the index of a frame's message in a list of messages that is known only at run time. For the
// project's own contract see routes.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil {

/// Looks up messages by the ids of frames.
class MessagePlaces {
 public:
  static constexpr std::size_t nowhere = 0xFF;
  /// The largest number of messages in a list.
  static constexpr std::size_t most = nowhere;

  /// `messages` must have at most `most` elements.
  explicit MessagePlaces(std::span<const MessageInfo> messages) {
    standard_.fill(nowhere);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      if (messages[i].extended)
        extended_[messages[i].id] = static_cast<std::uint8_t>(i);
      else
        standard_[messages[i].id] = static_cast<std::uint8_t>(i);
    }
  }

  /// The index of the frame's message; nowhere: the frame is an error frame, or no message has the id of the
  /// frame.
  [[nodiscard]] std::size_t operator()(const Frame& frame) const {
    if (frame.error) return nowhere;
    if (!frame.extended) return frame.id < standard_.size() ? standard_[frame.id] : nowhere;
    const auto found = extended_.find(frame.id);
    return found == extended_.end() ? nowhere : found->second;
  }

 private:
  std::array<std::uint8_t, 2048> standard_{};
  std::map<std::uint32_t, std::uint8_t> extended_;
};

}  // namespace canhil
