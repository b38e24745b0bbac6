// A bus on which the test plays the target.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "dbc/ports/port.hpp"
#include "dbc/wire/transmit.hpp"

namespace canhil::drive {

/// Passes every sent frame to `on_send`, which may call give(). All stamps are 0. Without a descriptor, a
/// wait for a frame returns at once. A wait for room pauses for 1 ms.
class FakePort : public Port {
 public:
  SendOutcome send(const Frame& frame) override {
    if (outcome != SendOutcome::sent) return outcome;
    const bool troubled = clock_ns(CLOCK_MONOTONIC) < trouble_until_ns;
    interface_up = !troubled || trouble != SendOutcome::down;
    if (troubled) return trouble;
    sent.push_back(frame);
    if (on_send) on_send(frame);
    return SendOutcome::sent;
  }
  std::optional<Received> receive() override {
    if (waiting_.empty()) return std::nullopt;
    const Received first = waiting_.front();
    waiting_.pop_front();
    return first;
  }
  bool wait_for_frame(std::int64_t deadline_ns) override {
    return descriptor() < 0 || Port::wait_for_frame(deadline_ns);
  }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] RoomWait room_wait() const override { return {.events = 0, .pause_ns = 1'000'000}; }
  [[nodiscard]] bool closed() const override { return gone; }
  [[nodiscard]] bool up() const override { return interface_up; }
  [[nodiscard]] PortCounters counters() const override { return {}; }
  [[nodiscard]] int stamp_clock() const override { return CLOCK_MONOTONIC; }
  [[nodiscard]] const std::string& name() const override { return name_; }

  /// Puts one message of the target on the bus.
  template <class Message>
  void give(const Message& message) {
    target.clear();
    target.send(message);
    give(target.frames().front());
  }
  void give(const Frame& frame) { waiting_.push_back({.frame = frame}); }
  void give(const Received& received) { waiting_.push_back(received); }

  std::function<void(const Frame&)> on_send;
  SendOutcome outcome = SendOutcome::sent;
  bool gone = false;
  SendOutcome trouble = SendOutcome::down;  ///< the outcome until trouble_until_ns on CLOCK_MONOTONIC
  std::int64_t trouble_until_ns = 0;
  bool interface_up = true;
  std::vector<Frame> sent;
  Outbox<1> target;

 private:
  std::deque<Received> waiting_;
  std::string name_ = "fake";
};

}  // namespace canhil::drive
