// What bench and target have said to each other in a run: who plays writes what was sent, who listens pairs
// answers with it.
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

/// A play that was sent once.
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
  std::vector<std::deque<Sent>> sent;            ///< by play, the newest last
  std::map<std::string, std::uint64_t> clipped;  ///< by MESSAGE.SIGNAL: how often it could not hold its value
};

/// Frames of the bench as they pass: a fault may keep some of a play from passing as they are, and then the
/// target has nothing to answer.
class Passing {
 public:
  explicit Passing(const Conversation& conversation)
      : conversation_(conversation), passed_(conversation.sent.size()) {}

  struct Whole {
    std::size_t play = 0;
    const Sent* sent = nullptr;
  };
  /// The play of which the last missing frame has passed with this one; none: it makes none whole.
  std::optional<Whole> take(const Frame& frame);

 private:
  struct Passed {
    std::int64_t valid_us = -1;
    std::set<std::size_t> frames;
  };
  const Conversation& conversation_;
  std::vector<Passed> passed_;  // of the newest, by play
};

/// What a frame of the target answers, by what it repeats, or by being the latest; null: nothing that is
/// remembered.
const Sent* cause_of(const Conversation& conversation, const Hear& hear, const Frame& frame);

}  // namespace canhil::mapping
