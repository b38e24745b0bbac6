#include "bench/run/link.hpp"

namespace canhil::run {

LinkState Link::send(const Frame& frame, std::int64_t patience_ns, std::int64_t late_ns) {
  const std::int64_t deadline_ns = clock_ns(CLOCK_MONOTONIC) + patience_ns;
  for (;;) {
    // The stamp is taken before: the answer of a fast target must not precede it.
    const std::int64_t t_ns = clock_ns(port_.stamp_clock());
    switch (port_.send(frame)) {
      case SendOutcome::sent:
        for (Observer* observer : observers_) observer->transmitted(frame, t_ns, late_ns);
        return LinkState::up;
      case SendOutcome::down:
      case SendOutcome::refused:
        return LinkState::down;
      case SendOutcome::queue_full:
        break;
    }
    if (clock_ns(CLOCK_MONOTONIC) >= deadline_ns) return LinkState::congested;
    // What fills the queue may be a target that waits for us to read its answers.
    if (drain() == LinkState::down) return LinkState::down;
    wait(port_, WaitFor::room, deadline_ns);
  }
}

LinkState Link::drain() {
  while (auto received = port_.receive()) {
    for (Observer* observer : observers_) observer->received(*received);
  }
  return port_.closed() ? LinkState::down : LinkState::up;
}

void Link::wait_until(std::int64_t deadline_ns) {
  if (port_.descriptor() < 0) return;  // no bus: what there is to receive came when we sent
  wait(port_, WaitFor::frame, deadline_ns);
}

}  // namespace canhil::run
