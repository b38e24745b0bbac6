#include "target/process/bus_notes.hpp"

#include <fmt/format.h>

#include <ctime>

namespace canhil::target {
namespace {

constexpr std::int64_t flood_period_ns = 1'000'000'000;

bool state_changed(const BusErrors& before, const BusErrors& now) {
  return before.bus_off != now.bus_off || before.restarted != now.restarted || before.passive != now.passive;
}

}  // namespace

void BusNotes::interface_is(bool up) {
  if (up == up_) return;
  const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
  if (up) {
    last_outage_ns_ = now_ns - changed_ns_;
  } else {
    ++downs_;
  }
  up_ = up;
  changed_ns_ = now_ns;
}

std::string BusNotes::news(const Port& port, BusFormat format) {
  std::string lines;
  const auto add = [&](const std::string& what) { lines += fmt::format("{}: {}\n", port.name(), what); };
  const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
  if (errors_ != reported_.errors &&
      (state_changed(reported_.errors, errors_) || now_ns - reported_.errors_ns >= flood_period_ns)) {
    add(fmt::format("{} error frames ({})", errors_.frames, to_text(errors_)));
    reported_.errors = errors_;
    reported_.errors_ns = now_ns;
  }
  if (up_ && (!reported_.up || downs_ != reported_.downs)) {
    add(fmt::format("up again after {:.1f} s; {} frames were not sent meanwhile",
                    static_cast<double>(last_outage_ns_) * 1e-9, unsent_));
    unsent_ = 0;
  } else if (!up_ && downs_ != reported_.downs) {
    add("the interface is down or removed; waiting for it");
  }
  reported_.up = up_;
  reported_.downs = downs_;
  if (late_in_queue_ != reported_.late_in_queue) {
    add(fmt::format("late in transmit queue: {} frames since the start, not sent", late_in_queue_));
    reported_.late_in_queue = late_in_queue_;
  }
  if (const std::uint64_t overflowed = port.counters().overflowed; overflowed != reported_.overflowed) {
    add(fmt::format("the receive queue overflowed: {} frames lost since the start", overflowed));
    reported_.overflowed = overflowed;
  }
  const std::uint64_t foreign = port.counters().foreign;
  if (foreign != reported_.foreign && now_ns - reported_.foreign_ns >= flood_period_ns) {
    const BusFormat other = format == BusFormat::fd ? BusFormat::classic : BusFormat::fd;
    add(fmt::format("received {}, {} since the start, expected {}", to_text(other), foreign,
                    to_text(format)));
    reported_.foreign = foreign;
    reported_.foreign_ns = now_ns;
  }
  return lines;
}

}  // namespace canhil::target
