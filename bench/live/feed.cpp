#include "bench/live/feed.hpp"

#include <array>

namespace canhil::live {

void Feed::transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  for (std::size_t plant = 0; plant < plants_.size(); ++plant) {
    const world::PlantRecord& record = *plants_[plant];
    for (; followed_[plant] < record.times_us().size(); ++followed_[plant]) {
      const std::int64_t t_us = record.times_us()[followed_[plant]];
      const std::size_t columns = record.columns().size();
      row_ = {static_cast<double>(plant), static_cast<double>(columns), static_cast<double>(t_us),
              record.ended_us == t_us ? 1.0 : 0.0};
      for (std::size_t i = 0; i < columns; ++i) row_.push_back(record.value(i, followed_[plant]));
      if (values_.write_available() >= row_.size())
        values_.push(row_.data(), row_.size());
      else
        drop();
    }
  }
  put({.kind = Event::Kind::transmitted, .t_ns = t_ns, .late_ns = late_ns, .received = {.frame = frame}});
}

std::uint64_t Feed::drain(observe::Observer& to, std::span<world::PlantRecord> copies) {
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
  std::array<double, 4> head{};
  while (values_.read_available() >= head.size()) {
    values_.pop(head.data(), head.size());
    std::vector<double> row(static_cast<std::size_t>(head[1]));
    values_.pop(row.data(), row.size());
    const auto plant = static_cast<std::size_t>(head[0]);
    if (plant >= copies.size()) continue;
    const auto t_us = static_cast<std::int64_t>(head[2]);
    copies[plant].add(t_us, row);
    if (head[3] != 0) copies[plant].ended_us = t_us;
  }
  return count;
}

}  // namespace canhil::live
