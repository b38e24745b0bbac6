// Whether one target answers or two: of two on one bus each spoils the other's groups, and no figure holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "bench/observe/observer.hpp"

namespace canhil::observe {

/// Watches what a target says of itself (heartbeats, acknowledgements, ends of steps, timing, counters). Each
/// of these messages carries a counter that goes up by one. A frame that continues not the last frame but an
/// earlier one has a sender of its own; several in a short time are a second target. Lost frames make no such
/// sequence: nearly a whole period of the counter would have to get lost again and again, each within a few
/// heartbeats.
class SecondTarget final : public Observer {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;

  [[nodiscard]] bool found() const { return found_; }
  /// What a person is told.
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
  int strange_ = 0;  // frames of a sender of their own
  int plain_ = 0;    // in a row since
  bool found_ = false;
};

}  // namespace canhil::observe
