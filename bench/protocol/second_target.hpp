// Detects a second target. Two targets on one bus spoil each other's groups, so no result is valid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "bench/observe/observer.hpp"

namespace canhil::protocol {

/// Watches messages in which a target reports its own state (heartbeats, acknowledgements, ends of steps,
/// timing, counters). Each message carries a counter that increases by one. If the counter of a frame
/// continues the counter of an earlier frame instead of that of the last frame, this frame and the last frame
/// have different senders. Several such frames within a short time mean a second target. Lost frames do not
/// have this effect: almost a whole period of the counter would have to be lost repeatedly, each time within
/// a few heartbeats.
class SecondTarget final : public observe::Observer {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  [[nodiscard]] bool found() const { return found_; }
  /// The message for users.
  static constexpr const char* complaint = "a second target answers on this bus";

 private:
  struct Seen {
    std::uint8_t counter = 0;
    std::int64_t t_ns = 0;
  };
  /// The last frames of one message, the newest first.
  using History = std::deque<Seen>;

  static bool continues_an_earlier_one(const History& history, const Seen& now);

  std::array<History, 5> histories_;
  int strange_ = 0;  // frames from another sender
  int plain_ = 0;    // frames since the last frame that counted in strange_
  bool found_ = false;
};

}  // namespace canhil::protocol
