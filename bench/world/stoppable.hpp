// Ends the computation of a truth early: a long one takes seconds, and a signal must end a command at once.
#pragma once

#include <atomic>

namespace canhil::world {

/// While this object lives, a FlightRecord that this thread computes ends early if `stop` becomes true. The
/// record is then incomplete: discard it.
class Stoppable {
 public:
  explicit Stoppable(const std::atomic<bool>& stop) : before_(stop_) { stop_ = &stop; }
  ~Stoppable() { stop_ = before_; }
  Stoppable(const Stoppable&) = delete;
  Stoppable& operator=(const Stoppable&) = delete;

  [[nodiscard]] static bool stopped() { return stop_ != nullptr && *stop_; }

 private:
  inline static thread_local const std::atomic<bool>* stop_ = nullptr;
  const std::atomic<bool>* before_;
};

}  // namespace canhil::world
