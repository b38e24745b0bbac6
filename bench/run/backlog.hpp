// Frames that come faster than the bench can look at them, and whose they are.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dbc/wire/frame.hpp"

namespace canhil::run {

/// A time for which frames waited with hardly a break.
struct Flood {
  std::int64_t duration_ns = 0;
  std::uint64_t frames = 0;  ///< that the bench looked at in it
  std::uint32_t id = 0;      ///< whose frames were the most
  bool extended = false;
  std::uint64_t of_id = 0;  ///< how many these were
};

/// "the bus was flooded by id 0C0: 900 of 1000 frames in 0.41 s".
std::string words(const Flood& flood);

class Backlog {
 public:
  /// The bench has looked at a frame.
  void add(const Frame& frame) {
    if (since_ns_) ++frames_[{frame.id, frame.extended}];
  }
  /// The bench turns to something else at `now_ns`. `more`: frames may still be waiting.
  void pause(bool more, std::int64_t now_ns);
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
  std::map<std::pair<std::uint32_t, bool>, std::uint64_t> frames_;
  std::optional<Flood> longest_;
};

}  // namespace canhil::run
