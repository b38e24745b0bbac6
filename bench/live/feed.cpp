#include "bench/live/feed.hpp"

namespace canhil::live {

void Feed::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  for (; engagement_ != nullptr && followed_ < engagement_->epochs.size(); ++followed_) {
    if (!epochs_.push(engagement_->epochs[followed_])) drop();
  }
  put({.kind = Event::Kind::transmitted, .t_ns = t_ns, .late_ns = late_ns, .received = {.frame = frame}});
}

std::uint64_t Feed::drain(observe::Observer& to, world::EngagementRecord* engagement) {
  std::uint64_t count = 0;
  Event event;
  // Reads only the events that are queued when the loop starts; otherwise the loop would not end while new
  // events arrive fast.
  for (std::size_t left = events_.read_available(); left > 0 && events_.pop(event); --left, ++count) {
    switch (event.kind) {
      case Event::Kind::transmitted:
        to.transmitted(event.received.frame, event.t_ns, event.late_ns);
        break;
      case Event::Kind::received:
        to.received(event.received);
        break;
      case Event::Kind::foreign:
        to.foreign(event.received);
        break;
      case Event::Kind::time_set:
        to.time_set(event.t_ns);
        break;
      case Event::Kind::interface_changed:
        to.interface_changed(event.up, event.t_ns);
        break;
    }
  }
  world::EngagementTruth epoch;
  while (epochs_.pop(epoch)) {
    if (engagement != nullptr) engagement->epochs.push_back(epoch);
  }
  return count;
}

}  // namespace canhil::live
