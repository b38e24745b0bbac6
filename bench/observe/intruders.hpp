// Detects other senders of the bench's own messages. The target would answer both senders.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "bench/observe/observer.hpp"
#include "dbc/wire/message_places.hpp"

namespace canhil::observe {

/// Counts frames that other nodes send with the id of a message that the bench has sent in this run.
class Intruders final : public Observer {
 public:
  /// `messages`: the messages of the bus.
  explicit Intruders(std::span<const MessageInfo> messages)
      : messages_(messages), places_(messages), ours_(messages.size()) {}
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  /// The number of frames from other senders, by message name.
  [[nodiscard]] const std::map<std::string_view, std::uint64_t>& frames() const { return frames_; }

 private:
  std::span<const MessageInfo> messages_;
  MessagePlaces places_;
  std::vector<bool> ours_;  // by index in messages_
  std::map<std::string_view, std::uint64_t> frames_;
};

}  // namespace canhil::observe
