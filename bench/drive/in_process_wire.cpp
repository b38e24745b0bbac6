#include "bench/drive/in_process_wire.hpp"

#include <algorithm>
#include <utility>

#include "dbc/wire/frame_rules.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t heartbeat_ns = messages::TargetHeartbeat::info.cycle_time_us * 1000;

}  // namespace

InProcessWire::InProcessWire(std::string name, const WireSettings& settings, BusFormat format)
    : name_(std::move(name)),
      fd_(format == BusFormat::fd),
      facts_(settings.facts()),
      wire_(settings.rates,
            {{.order = settings.order, .reports_errors = true},
             {.order = settings.order, .reports_errors = true}},
            disturbance(settings)) {}

SendOutcome InProcessWire::send(const Frame& frame) {
  if (frame.error || !can_carry(frame, fd_)) return SendOutcome::refused;
  if (!wire_.queue(bench, frame, now_ns_)) return SendOutcome::queue_full;
  ++counters_.sent;
  return SendOutcome::sent;
}

std::optional<Received> InProcessWire::receive() {
  if (ready_.empty()) return std::nullopt;
  const Received received = ready_.front();
  ready_.pop_front();
  ++counters_.received;
  if (received.frame.error) ++counters_.error_frames;
  return received;
}

bool InProcessWire::wait_for_frame(std::int64_t deadline_ns) {
  while (ready_.empty() && next_event_ns() <= deadline_ns) pass(next_event_ns());
  if (!ready_.empty()) return true;
  pass(deadline_ns);
  return false;
}

bool InProcessWire::wait_for_room(std::int64_t deadline_ns) {
  const std::int64_t event_ns = next_event_ns();
  pass(std::min(event_ns, deadline_ns));
  return event_ns <= deadline_ns;
}

std::int64_t InProcessWire::next_event_ns() const {
  return std::max(now_ns_, std::min(wire_.next_event_ns(), idle_heartbeat_due_ns_));
}

/// Advances the time to `until_ns` and processes the events on the wire up to that time.
void InProcessWire::pass(std::int64_t until_ns) {
  now_ns_ = std::max(now_ns_, until_ns);
  if (idle_heartbeat_due_ns_ <= now_ns_) {
    put(device_.idle_heartbeat(), std::exchange(idle_heartbeat_due_ns_, now_ns_ + heartbeat_ns));
  }
  for (;;) {
    while (const auto report = wire_.report()) {
      if (report->node == bench) give(report->frame, report->t_ns, false);
    }
    queue_waiting();
    if (const auto carried = wire_.next(now_ns_)) {
      arrive(*carried);
    } else if (!wire_.has_report()) {
      return;
    }
  }
}

void InProcessWire::arrive(const Carried& carried) {
  const bool own = carried.node == bench;
  give(carried.frame, carried.delivered_ns, own);
  if (!own) return;
  idle_heartbeat_due_ns_ = SimulatedWire::never;
  const FdUnpacked unpacked = fd_ ? FdUnpacked(carried.frame) : FdUnpacked();
  for (const Frame& frame : fd_ ? unpacked.frames() : std::span(&carried.frame, 1))
    put(device_.receive(frame), carried.delivered_ns);
}

/// Queues the frames that the device sends.
void InProcessWire::put(std::span<const Frame> answers, std::int64_t t_ns) {
  const auto onto_wire = [&](const Frame& frame) { queue(frame, t_ns); };
  for (const Frame& frame : answers) fd_ ? packer_.pack(frame, onto_wire) : onto_wire(frame);
}

void InProcessWire::queue(const Frame& frame, std::int64_t t_ns) {
  if (!waiting_.empty() || !wire_.queue(device, frame, t_ns)) waiting_.push_back(frame);
}

/// While the device's queue is full or the device is bus-off, frames of the device wait for room, without a
/// time limit. (In contrast, hil-target gives up after 50 ms.)
void InProcessWire::queue_waiting() {
  while (!waiting_.empty() && wire_.queue(device, waiting_.front(), now_ns_)) waiting_.pop_front();
}

void InProcessWire::give(const Frame& frame, std::int64_t t_ns, bool own) {
  ready_.push_back({.frame = frame, .t_ns = t_ns, .source = StampSource::virtual_time, .own = own});
}

}  // namespace canhil::drive
