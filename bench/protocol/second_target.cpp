#include "bench/protocol/second_target.hpp"

#include <algorithm>
#include <optional>

#include "bench/nodes/is_whole.hpp"
#include "dbc/wire/e2e.hpp"
#include "messages/canhil.hpp"

namespace canhil::protocol {
namespace {

using namespace messages;

// The number of frames that are remembered. A target sends the heartbeats of all its estimators at once, so
// several frames of one target may lie between two frames of another target.
constexpr std::size_t longest_history = 8;
constexpr std::int64_t history_ns = TargetHeartbeat::info.cycle_time_us * 2500;
constexpr int strange_enough = 3;
constexpr int plain_enough = 16;

// The history that a frame belongs to.
std::optional<std::size_t> kind_of(const Frame& frame) {
  if (nodes::is_whole<TargetHeartbeat>(frame)) return 0;
  if (nodes::is_whole<ParamAck>(frame)) return 1;
  if (nodes::is_whole<StepDone>(frame)) return 2;
  if (nodes::is_whole<TargetTiming>(frame)) return 3;
  if (nodes::is_whole<TargetCounters>(frame)) return 4;
  return std::nullopt;
}

}  // namespace

// After a command the target may restart its counters, so the earlier frames are forgotten.
void SecondTarget::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (frame.id != TargetCommand::info.id) return;
  for (History& history : histories_) history.clear();
}

void SecondTarget::received(const Received& received) {
  if (received.own) return;
  const auto kind = kind_of(received.frame);
  if (!kind) return;
  const Seen now{.counter = e2e::counter(received.frame.payload()), .t_ns = received.t_ns};
  History& history = histories_.at(*kind);
  if (continues_an_earlier_one(history, now)) {
    plain_ = 0;
    found_ = found_ || ++strange_ >= strange_enough;
  } else if (++plain_ >= plain_enough) {
    strange_ = 0;
  }
  history.push_front(now);
  if (history.size() > longest_history) history.pop_back();
}

bool SecondTarget::continues_an_earlier_one(const History& history, const Seen& now) {
  const auto precedes = [&](const Seen& before) {
    return e2e::next(before.counter) == now.counter && now.t_ns - before.t_ns < history_ns;
  };
  return !history.empty() && e2e::next(history.front().counter) != now.counter &&
         std::ranges::any_of(history, precedes);
}

}  // namespace canhil::protocol
