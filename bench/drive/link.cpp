#include "bench/drive/link.hpp"

#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t late_in_queue_ns = messages::Sync::info.cycle_time_us * 1000;

}  // namespace

LinkState Link::send(const Frame& frame, std::int64_t patience_ns, std::optional<std::int64_t> due_ns) {
  std::int64_t late_ns = 0;
  const SendOutcome outcome = try_to_send(frame, due_ns, late_ns);
  return outcome == SendOutcome::sent ? LinkState::up : send_again(frame, patience_ns, due_ns, outcome);
}

LinkState Link::send_all(std::span<const Frame> frames, std::int64_t patience_ns) {
  const std::int64_t t_ns = port_.now_ns();
  const std::size_t sent = port_.send_all(frames);
  if (!up_) look_at_interface();
  for (const Frame& frame : frames.first(sent)) tell_sent(frame, t_ns, 0);
  for (const Frame& frame : frames.subspan(sent)) {
    if (const LinkState state = send(frame, patience_ns); state != LinkState::up) return state;
  }
  return LinkState::up;
}

LinkState Link::post(std::span<const Frame> frames, std::int64_t patience_ns) {
  if (port_.capabilities().in_process) return send_all(frames, patience_ns);
  const std::int64_t t_ns = port_.now_ns();
  for (const Frame& frame : frames) tell_sent(frame, t_ns, 0);
  posted_.insert(posted_.end(), frames.begin(), frames.end());
  return LinkState::up;
}

LinkState Link::flush(std::int64_t patience_ns) {
  if (posted_.empty()) return LinkState::up;
  told_ = true;
  const LinkState state = send_all(posted_, patience_ns);
  told_ = false;
  posted_.clear();
  return state;
}

void Link::tell_sent(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) {
  if (told_) return;
  for (observe::Observer* observer : observers_) observer->transmitted(frame, t_ns, late_ns);
}

SendOutcome Link::try_to_send(const Frame& frame, std::optional<std::int64_t> due_ns, std::int64_t& late_ns) {
  // The stamp is taken before the frame is sent: the answer of a fast target must not have an earlier stamp.
  const std::int64_t t_ns = port_.now_ns();
  late_ns = due_ns ? port_.monotonic_ns() - *due_ns : 0;
  const SendOutcome outcome = port_.send(frame);
  if (outcome != SendOutcome::sent || !up_) look_at_interface();
  if (outcome != SendOutcome::sent) return outcome;
  tell_sent(frame, t_ns, late_ns);
  return outcome;
}

// Most frames are accepted at once, so this is apart from send().
LinkState Link::send_again(const Frame& frame, std::int64_t patience_ns, std::optional<std::int64_t> due_ns,
                           SendOutcome outcome) {
  const std::int64_t deadline_ns = port_.monotonic_ns() + patience_ns;
  for (;;) {
    const bool may_return = outcome == SendOutcome::down && !port_.up();
    if (outcome != SendOutcome::queue_full && !may_return) return LinkState::down;
    if (!while_waiting_) while_waiting_.emplace();
    if (port_.monotonic_ns() >= deadline_ns) {
      crowd_ = while_waiting_->frames() == 0 ? "" : while_waiting_->to_text();
      while_waiting_.reset();
      return may_return ? LinkState::down : LinkState::congested;
    }
    // The queue may be full because a target waits until the bench reads the target's answers.
    if (drain() == LinkState::down) return LinkState::down;
    if (!backlog_.more()) wait(port_, WaitFor::room, deadline_ns);
    std::int64_t late_ns = 0;
    outcome = try_to_send(frame, due_ns, late_ns);
    if (outcome != SendOutcome::sent) continue;
    while_waiting_.reset();
    if (late_ns > late_in_queue_ns) ++late_in_queue_;
    return LinkState::up;
  }
}

LinkState Link::drain() {
  int looked_at = 0;
  for (; looked_at < most_at_once; ++looked_at) {
    const auto received = port_.receive();
    if (!received) break;
    backlog_.add(received->frame);
    if (while_waiting_ && !received->own) while_waiting_->add(received->frame);
    for (observe::Observer* observer : observers_)
      received->foreign ? observer->foreign(*received) : observer->received(*received);
  }
  const bool more = looked_at == most_at_once;
  if (more || backlog_.stands()) {
    const std::uint64_t before = overflowed_;
    if (more) overflowed_ = port_.counters().overflowed;  // a system call, so only on demand
    backlog_.pause(more, overflowed_ > before, port_.monotonic_ns());
  }
  look_at_interface();
  return port_.closed() ? LinkState::down : LinkState::up;
}

void Link::look_at_interface() {
  if (port_.up() == up_) return;
  up_ = port_.up();
  for (observe::Observer* observer : observers_) observer->interface_changed(up_, port_.now_ns());
}

// A port may read several frames at once. It does not signal frames that it has read but not yet returned.
bool Link::wait_until(std::int64_t deadline_ns) {
  return backlog_.more() || wait(port_, WaitFor::frame, deadline_ns);
}

}  // namespace canhil::drive
