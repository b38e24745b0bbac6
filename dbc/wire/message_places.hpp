// From a frame's id to its message's place in a list that is known only at run time. Of the project's own
// contract: routes.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/message_info.hpp"

namespace canhil {

class MessagePlaces {
 public:
  static constexpr std::size_t nowhere = 0xFF;
  /// So many messages a list has at the most.
  static constexpr std::size_t most = nowhere;

  explicit MessagePlaces(std::span<const MessageInfo> messages) {
    standard_.fill(nowhere);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      if (messages[i].extended)
        extended_[messages[i].id] = static_cast<std::uint8_t>(i);
      else
        standard_[messages[i].id] = static_cast<std::uint8_t>(i);
    }
  }

  /// nowhere: of error frames, and of ids that no message has.
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
