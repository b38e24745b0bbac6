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
  const auto tell = [&](const std::string& what) { lines += fmt::format("{}: {}\n", port.name(), what); };
  const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
  if (errors_ != told_.errors &&
      (state_changed(told_.errors, errors_) || now_ns - told_.errors_ns >= flood_period_ns)) {
    tell(fmt::format("{} error frames ({})", errors_.frames, to_text(errors_)));
    told_.errors = errors_;
    told_.errors_ns = now_ns;
  }
  if (up_ && (!told_.up || downs_ != told_.downs)) {
    tell(fmt::format("up again after {:.1f} s; {} frames were not sent meanwhile",
                     static_cast<double>(last_outage_ns_) * 1e-9, unsent_));
    unsent_ = 0;
  } else if (!up_ && downs_ != told_.downs) {
    tell("the interface is down or removed; waiting for it");
  }
  told_.up = up_;
  told_.downs = downs_;
  if (late_in_queue_ != told_.late_in_queue) {
    tell(fmt::format("late in transmit queue: {} frames since the start, not sent", late_in_queue_));
    told_.late_in_queue = late_in_queue_;
  }
  if (const std::uint64_t overflowed = port.counters().overflowed; overflowed != told_.overflowed) {
    tell(fmt::format("the receive queue overflowed: {} frames lost since the start", overflowed));
    told_.overflowed = overflowed;
  }
  const std::uint64_t foreign = port.counters().foreign;
  if (foreign != told_.foreign && now_ns - told_.foreign_ns >= flood_period_ns) {
    const BusFormat other = format == BusFormat::fd ? BusFormat::classic : BusFormat::fd;
    tell(fmt::format("received {}, {} since the start, expected {}", to_text(other), foreign,
                     to_text(format)));
    told_.foreign = foreign;
    told_.foreign_ns = now_ns;
  }
  return lines;
}

}  // namespace canhil::target
