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

/// Follows frames of the bench on their way to the bus. If a fault drops or changes a frame of a play, the
/// target need not answer the play.
class Passing {
 public:
  explicit Passing(const Conversation& conversation)
      : conversation_(conversation), passed_(conversation.sent.size()), in_part_(conversation.sent.size()) {}

  struct Whole {
    std::size_t play = 0;
    const Sent* sent = nullptr;
  };
  /// The play that this frame completes; none: the frame completes no play.
  std::optional<Whole> take(const Frame& frame);
  /// Whether this message of a transmission reached the bus, but the transmission as a whole did not. A
  /// target may answer it, for example with the samples of a redundant sensor.
  [[nodiscard]] bool brought_in_part(std::size_t play, std::int64_t valid_us, std::size_t message) const;

 private:
  struct Passed {
    std::int64_t valid_us = -1;
    std::set<std::size_t> frames;
    std::vector<std::size_t> message_of;  // as in Sent
  };
  const Conversation& conversation_;
  std::vector<Passed> passed_;  // the newest transmission of each play
  std::vector<std::deque<Passed>>
      in_part_;  // for each play: earlier transmissions of which a frame is missing
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
