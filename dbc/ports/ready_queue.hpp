// The frames that the host of the embedded bus receives next.
#pragma once

#include <sys/eventfd.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "dbc/ports/descriptor.hpp"
#include "dbc/ports/port.hpp"

namespace canhil::local {

/// A queue that can end a wait of poll().
class ReadyQueue {
 public:
  /// Whether a wait must end for these frames. Frames that receive() itself has read need no wake-up: its
  /// caller calls it again until no frame is left.
  enum class Wake : std::uint8_t { yes, no };

  /// Makes wake-ups possible; returns the descriptor, which is readable while frames with Wake::yes are
  /// waiting.
  int enable_wake() {
    event_ = Descriptor(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
    return event_.get();
  }

  /// Adds a frame with its stamp [ns, CLOCK_MONOTONIC]. `own`: the host sent it.
  void push(const Frame& frame, std::int64_t t_ns, bool own, Wake wake) {
    if (wake == Wake::yes && !std::exchange(signalled_, true)) ::eventfd_write(event_.get(), 1);
    frames_.push_back({.frame = frame, .t_ns = t_ns, .source = StampSource::hub, .own = own});
  }

  /// Removes and returns the first frame; the queue must not be empty.
  Received pop() {
    const Received received = frames_.front();
    frames_.pop_front();
    eventfd_t events = 0;
    if (frames_.empty() && std::exchange(signalled_, false)) ::eventfd_read(event_.get(), &events);
    return received;
  }

  /// Whether no frame is waiting.
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  /// The number of frames that are waiting.
  [[nodiscard]] std::size_t size() const { return frames_.size(); }

 private:
  Descriptor event_;
  bool signalled_ = false;
  std::deque<Received> frames_;
};

}  // namespace canhil::local
