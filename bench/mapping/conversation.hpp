// The exchange between bench and target in a run: the player records what it sent; the listener assigns each
// answer to its cause.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/mapping/mapping.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::mapping {

/// One transmission of a play (a group of messages that the bench sends together).
struct Sent {
  std::int64_t valid_us = 0;
  std::int64_t due_us = 0;
  std::vector<Frame> frames;  ///< one per message, in the order of the play
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
  std::map<std::string, std::uint64_t>
      clipped;  ///< by MESSAGE.SIGNAL: number of values beyond the signal's range
};

/// Follows frames of the bench on their way to the bus. If a fault drops or changes a frame of a play, the
/// target need not answer the play.
class Passing {
 public:
  explicit Passing(const Conversation& conversation)
      : conversation_(conversation), passed_(conversation.sent.size()) {}

  struct Whole {
    std::size_t play = 0;
    const Sent* sent = nullptr;
  };
  /// The play that this frame completes; none: the frame completes no play.
  std::optional<Whole> take(const Frame& frame);

 private:
  struct Passed {
    std::int64_t valid_us = -1;
    std::set<std::size_t> frames;
  };
  const Conversation& conversation_;
  std::vector<Passed> passed_;  // the newest transmission of each play
};

/// The stimulus that is the cause of a frame of the target. If the target echoes a signal, the cause is the
/// stored stimulus in which this signal has the echoed value; otherwise the cause is the latest stimulus.
/// Null: no stored stimulus matches.
const Sent* cause_of(const Conversation& conversation, const Hear& hear, const Frame& frame);

}  // namespace canhil::mapping
