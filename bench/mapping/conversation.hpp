// The exchange between bench and target in a run: the player records what it sent, the listener pairs answers
// with it.
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

/// One transmission of a play.
struct Sent {
  std::int64_t valid_us = 0;
  std::int64_t due_us = 0;
  std::vector<Frame> frames;  ///< of its messages, in their order
};

struct Conversation {
  explicit Conversation(const Mapping& of) : mapping(of), sent(of.plays.size()) {}

  static constexpr std::size_t remembered = 256;

  void add(std::size_t play, Sent one) {
    if (sent[play].size() == remembered) sent[play].pop_front();
    sent[play].push_back(std::move(one));
  }

  const Mapping& mapping;
  std::vector<std::deque<Sent>> sent;  ///< by play, the newest last
  std::map<std::string, std::uint64_t>
      clipped;  ///< by MESSAGE.SIGNAL: how often the value exceeded the signal's range
};

/// Frames of the bench on their way to the bus. A fault may drop or change frames of a play; then the target
/// has nothing to answer.
class Passing {
 public:
  explicit Passing(const Conversation& conversation)
      : conversation_(conversation), passed_(conversation.sent.size()) {}

  struct Whole {
    std::size_t play = 0;
    const Sent* sent = nullptr;
  };
  /// The play that became complete with this frame; none: it completes none.
  std::optional<Whole> take(const Frame& frame);

 private:
  struct Passed {
    std::int64_t valid_us = -1;
    std::set<std::size_t> frames;
  };
  const Conversation& conversation_;
  std::vector<Passed> passed_;  // the newest for each play
};

/// The cause of a target's frame: the stimulus that it echoes, or else the latest; null: none that is still
/// remembered.
const Sent* cause_of(const Conversation& conversation, const Hear& hear, const Frame& frame);

}  // namespace canhil::mapping
