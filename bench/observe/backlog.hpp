// Detects frames that come faster than the bench can process them, and reports their most frequent id.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dbc/wire/frame.hpp"

namespace canhil::observe {

/// Counts the frames of an interval by id.
class Shares {
 public:
  void add(const Frame& frame);
  void clear();
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// Returns a text such as "id 0C0: 900 of 1000 frames" or "error frames: 600 of 1000 frames". If no id has
  /// half of the frames, the text also contains the number of ids.
  [[nodiscard]] std::string to_text() const;

 private:
  // Limits the number of ids that are counted separately: counts for 2^29 extended ids would fill the memory.
  static constexpr std::size_t most_ids = 4096;
  std::uint64_t frames_ = 0;
  std::uint64_t error_frames_ = 0;
  std::map<std::pair<std::uint32_t, bool>, std::uint64_t> by_id_;  // the flag is true for an extended id
};

/// An interval in which frames were waiting almost continuously.
struct Flood {
  std::int64_t duration_ns = 0;
  std::string whose{};  ///< the most frequent id among the frames processed in this interval:
                        ///< Shares::to_text()
};

/// Returns a text such as "the bus was flooded by id 0C0: 900 of 1000 frames in 0.41 s".
std::string to_text(const Flood& flood);

class Backlog {
 public:
  /// The bench has processed a frame.
  void add(const Frame& frame) {
    if (since_ns_) shares_.add(frame);
  }
  /// The bench stops reading frames at `now_ns`. `more`: frames may still be waiting. `overflowed`: the port
  /// has lost frames since the last pause, so frames were waiting all the time, even if the bench had no CPU.
  void pause(bool more, bool overflowed, std::int64_t now_ns);
  /// Whether frames were waiting at the last pause.
  [[nodiscard]] bool more() const { return more_; }
  /// Whether a backlog exists: frames were waiting at one of the last pauses. If so, pause() must be called
  /// after each reading, even if no frames are waiting any more.
  [[nodiscard]] bool stands() const { return since_ns_.has_value(); }

  /// The longest flood so far. A backlog that the bench itself caused is shorter than a flood and does not
  /// count.
  [[nodiscard]] const std::optional<Flood>& flood() const { return longest_; }

 private:
  bool more_ = false;
  std::optional<std::int64_t> since_ns_;  // start of the current backlog
  std::int64_t last_ns_ = 0;              // the latest time at which frames were waiting
  Shares shares_;
  std::optional<Flood> longest_;
};

}  // namespace canhil::observe
