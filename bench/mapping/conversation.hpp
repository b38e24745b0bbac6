// The exchange between bench and target in a run: the player records what it sent; the listener assigns each
// answer to its cause.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::mapping {

/// One transmission of a play (a group of messages that the bench sends together).
struct Sent {
  std::int64_t valid_us = 0;
  std::int64_t due_us = 0;
  std::vector<std::vector<std::uint8_t>> messages{};  ///< the bytes of each message, in the order of the play
  std::vector<Frame> frames{};                        ///< of all messages, in the order of transmission
  std::vector<std::size_t> message_of{};              ///< for each frame: the index of its message
};

struct Conversation {
  explicit Conversation(const Mapping& of) : mapping(of), sent(of.plays.size()) {}

  static constexpr std::size_t remembered = 256;

  void add(std::size_t play, Sent one) {
    if (sent[play].size() == remembered) sent[play].pop_front();
    sent[play].push_back(std::move(one));
  }

  const Mapping& mapping;
  std::vector<std::deque<Sent>> sent;  ///< transmissions of each play, the newest last
  /// Receives each value that is played, in the unit of its signal, before it is encoded; null: nobody wants
  /// it.
  std::function<void(const Source& source, double value)> on_value{};
};

/// Follows frames of the bench on their way to the bus. The target must answer a play if all its frames came
/// as they were made, and before any frame of the next. It may answer what else a fault lets through: a part,
/// frames that others overtook, frames that were changed and have no checksum.
class Passing {
 public:
  explicit Passing(const Conversation& conversation)
      : conversation_(conversation), passed_(conversation.sent.size()) {}

  struct Whole {
    std::size_t play = 0;
    const Sent* sent = nullptr;
  };
  /// The play that this frame completes, so that the target must answer it; none: the frame completes no
  /// play.
  std::optional<Whole> take(const Frame& frame);
  /// Whether this message of a transmission reached the bus, but the target need not answer the transmission:
  /// for example, it may answer the samples of one of two redundant sensors.
  [[nodiscard]] bool may_answer(std::size_t play, std::int64_t valid_us, std::size_t message) const;
  /// Whether the message that a target echoes was changed on its way and then carried this value.
  [[nodiscard]] bool carried_changed(const Hear& hear, std::uint64_t echoed) const;

 private:
  struct Passed {
    std::int64_t valid_us = -1;
    std::vector<std::size_t> message_of;     // as in Sent
    std::set<std::size_t> frames{};          // indices of those that came
    std::map<std::size_t, Frame> changed{};  // by index: came with other bytes, which the target cannot see
    bool whole = false;                      // came in time, so the target must answer it
  };
  Passed& passed(std::size_t play, const Sent& sent);
  void take_changed(const Frame& frame);

  const Conversation& conversation_;
  std::vector<std::deque<Passed>> passed_;  // for each play: transmissions of which a frame came, by time
};

/// The value that an answer echoes, and the value that a stimulus carries in the signal which is echoed. Both
/// have only those bits that both signals have. Without an echo, both are 0.
std::uint64_t echoed_by(const Hear& hear, std::span<const std::uint8_t> answer);
std::uint64_t carried_by(const Hear& hear, const Sent& stimulus);

/// The latest stored stimulus that carries the value which a message of the target echoes. Null: there is
/// none. Whether an earlier stimulus can be the cause too: see Pairing.
const Sent* cause_of(const Conversation& conversation, const Hear& hear,
                     std::span<const std::uint8_t> answer);

}  // namespace canhil::mapping
