#include "bench/run/link.hpp"

namespace canhil::run {

LinkState Link::send(const Frame& frame, std::int64_t patience_ns, std::optional<std::int64_t> due_ns) {
  std::int64_t deadline_ns = 0;  // looked up when it matters: most frames are taken at once
  for (;;) {
    // The stamp is taken before: the answer of a fast target must not precede it.
    const std::int64_t t_ns = port_.now_ns();
    const std::int64_t late_ns = due_ns ? clock_ns(CLOCK_MONOTONIC) - *due_ns : 0;
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
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    if (deadline_ns == 0) deadline_ns = now_ns + patience_ns;
    if (now_ns >= deadline_ns) return LinkState::congested;
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
