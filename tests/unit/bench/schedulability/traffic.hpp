// Random message sets, and their response times on the simulated wire.
#pragma once

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "bench/schedulability/analysis.hpp"
#include "dbc/ports/simulated_wire.hpp"
#include "dbc/wire/arbitration.hpp"

namespace canhil::schedulability {

struct MessageSet {
  Bus bus;
  std::vector<Stream> streams;  ///< by priority
  std::vector<Frame> frames;    ///< frames[i] is the frame of stream i; its length is streams[i].length
  std::vector<std::size_t> nodes;
  std::size_t node_count = 1;
};

/// When an instance of a stream becomes due, and when it is queued.
struct Due {
  std::size_t stream = 0;
  std::int64_t due_ns = 0;
  std::int64_t queued_ns = 0;
};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  /// A random integer from a to b, both included.
  std::int64_t operator()(std::int64_t a, std::int64_t b) {
    return std::uniform_int_distribution<std::int64_t>(a, b)(engine_);
  }

 private:
  std::mt19937_64 engine_;
};

/// Classic and FD frames with both id lengths. Data with long runs of equal bits is as frequent as random
/// data.
inline Frame random_frame(Dice& dice, bool fd_allowed) {
  constexpr std::array<std::uint8_t, 8> fd_sizes{0, 8, 12, 16, 20, 24, 48, 64};
  constexpr std::array<std::uint8_t, 6> runs{0x00, 0xFF, 0x0F, 0xF0, 0x87, 0x78};
  Frame frame{.extended = dice(0, 2) == 0, .fd = fd_allowed && dice(0, 1) == 1};
  frame.id = static_cast<std::uint32_t>(dice(0, frame.extended ? 0x1FFF'FFFF : 0x7FF));
  frame.size =
      frame.fd ? fd_sizes.at(static_cast<std::size_t>(dice(0, 7))) : static_cast<std::uint8_t>(dice(0, 8));
  frame.brs = frame.fd && dice(0, 3) > 0;
  for (std::size_t i = 0; i < frame.size; ++i)
    frame.data.at(i) = dice(0, 1) == 0 ? static_cast<std::uint8_t>(dice(0, 255))
                                       : runs.at(static_cast<std::size_t>(dice(0, 5)));
  return frame;
}

/// 2 to 8 messages from 2 to 4 nodes, with periods that give a bus load of up to 99 %.
inline MessageSet random_set(Dice& dice) {
  constexpr std::array<std::int64_t, 4> rates{83'333, 125'000, 500'000, 1'000'000};
  MessageSet set;
  set.bus.rates = {.nominal = rates.at(static_cast<std::size_t>(dice(0, 3))), .data = 2'000'000};
  set.node_count = static_cast<std::size_t>(dice(2, 4));
  const bool fd_allowed = dice(0, 2) == 0;
  std::set<std::uint32_t> ranks;
  const std::int64_t count = dice(2, 8);
  while (std::ssize(set.frames) < count) {
    const Frame frame = random_frame(dice, fd_allowed);
    if (ranks.insert(wire::arbitration_rank(frame.id, frame.extended)).second) set.frames.push_back(frame);
  }
  std::ranges::sort(set.frames, {}, [](const Frame& f) { return wire::arbitration_rank(f.id, f.extended); });
  const std::int64_t load_percent = dice(0, 1) == 0 ? dice(20, 90) : dice(90, 99);
  for (const Frame& frame : set.frames) {
    Stream& stream = set.streams.emplace_back();
    stream.id = frame.id;
    stream.extended = frame.extended;
    stream.length = wire::bit_length(frame);
    const std::int64_t share_ns =
        wire::duration_ns(stream.length, set.bus.rates) * count * 100 / load_percent;
    stream.period_ns = share_ns + dice(0, share_ns / (load_percent > 90 ? 100 : 3));
    stream.jitter_ns = dice(0, 2) == 0 ? dice(0, 2 * stream.period_ns) : 0;
    set.nodes.push_back(static_cast<std::size_t>(dice(0, static_cast<std::int64_t>(set.node_count) - 1)));
    stream.sender = std::to_string(set.nodes.back());
  }
  return set;
}

/// Sends due frames over the wire. Returns the longest response of each stream, from the due time to the end
/// of the intermission. `frame_of(due)` is the frame to send.
template <class FrameOf>
std::vector<std::int64_t> longest_responses(const MessageSet& set, std::vector<Due> dues, FrameOf&& frame_of,
                                            Disturb disturb = {}, QueueOrder order = QueueOrder::priority) {
  std::ranges::stable_sort(dues, {}, &Due::queued_ns);
  SimulatedWire wire(set.bus.rates,
                     std::vector<WireNode>(set.node_count, {.order = order, .depth = dues.size()}),
                     std::move(disturb));
  std::vector<std::vector<std::int64_t>> waiting(set.streams.size());  // due times, oldest first
  std::vector<std::int64_t> longest(set.streams.size(), 0);
  const auto take = [&](std::int64_t until_ns) {
    while (const auto carried = wire.next(until_ns)) {
      const auto found = std::ranges::find_if(set.frames, [&carried](const Frame& f) {
        return f.id == carried->frame.id && f.extended == carried->frame.extended;
      });
      const auto stream = static_cast<std::size_t>(found - set.frames.begin());
      longest[stream] = std::max(longest[stream], carried->end_ns - waiting[stream].front());
      waiting[stream].erase(waiting[stream].begin());
    }
  };
  for (const Due& due : dues) {
    take(due.queued_ns - 1);
    waiting[due.stream].push_back(due.due_ns);
    if (!wire.queue(set.nodes[due.stream], frame_of(due), due.queued_ns)) return {};
  }
  take(SimulatedWire::never / 2);
  for (const auto& left : waiting) {
    if (!left.empty()) return {};
  }
  return longest;
}

}  // namespace canhil::schedulability
