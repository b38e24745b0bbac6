// Frames that come faster than the bench can look at them, and whose they are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dbc/wire/frame.hpp"

namespace canhil::observe {

/// Whose frames a stretch of time brought.
class Shares {
 public:
  void add(const Frame& frame);
  void clear();
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// "id 0C0: 900 of 1000 frames"; "error frames: ..."; where no id has half of them, also of how many ids.
  [[nodiscard]] std::string to_text() const;

 private:
  // Of all ids that a flood can have only so many are told apart: 2^29 would fill the memory.
  static constexpr std::size_t most_ids = 4096;
  std::uint64_t frames_ = 0;
  std::uint64_t error_frames_ = 0;
  std::map<std::pair<std::uint32_t, bool>, std::uint64_t> by_id_;  // and whether it is extended
};

/// A time for which frames waited with hardly a break.
struct Flood {
  std::int64_t duration_ns = 0;
  std::string whose{};  ///< frames the bench looked at in it: Shares::to_text()
};

/// "the bus was flooded by id 0C0: 900 of 1000 frames in 0.41 s".
std::string to_text(const Flood& flood);

class Backlog {
 public:
  /// The bench has looked at a frame.
  void add(const Frame& frame) {
    if (since_ns_) shares_.add(frame);
  }
  /// The bench turns to something else at `now_ns`. `more`: frames may still be waiting. `overflowed`: the
  /// port has lost some since the last pause, so they waited all the while, however long the bench had no
  /// CPU.
  void pause(bool more, bool overflowed, std::int64_t now_ns);
  /// The last pause left frames waiting.
  [[nodiscard]] bool more() const { return more_; }
  /// Frames were left waiting a moment ago: pause() is to be called each time.
  [[nodiscard]] bool stands() const { return since_ns_.has_value(); }

  /// The longest flood until now: longer than a bench is ever behind by itself.
  [[nodiscard]] const std::optional<Flood>& flood() const { return longest_; }

 private:
  bool more_ = false;
  std::optional<std::int64_t> since_ns_;  // frames have been waiting again and again
  std::int64_t last_ns_ = 0;              // they were
  Shares shares_;
  std::optional<Flood> longest_;
};

}  // namespace canhil::observe
