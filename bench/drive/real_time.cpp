#include "bench/drive/real_time.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <optional>

#include "bench/observe/bus_watch.hpp"

namespace canhil::drive {
namespace {

constexpr std::int64_t ns_per_us = 1000;
constexpr std::int64_t lead_ns = 20'000'000;           // time between the call and the first deadline
constexpr std::int64_t last_answers_ns = 150'000'000;  // longer than a heartbeat period
constexpr std::int64_t outage_limit_ns =
    5'000'000'000;  // for an interface that goes down and up, or a restart after bus-off
constexpr std::int64_t progress_period_us = 100'000;

// A bus that was busy all the time is full; the message then names the frames that fill the bus.
std::string took_none(const Link& link, std::int64_t due_us) {
  return fmt::format("the bus has accepted no frame since t={:.3f} s{}{}", static_cast<double>(due_us) * 1e-6,
                     link.crowd().empty() ? "" : " and carried ", link.crowd());
}

}  // namespace

Ending run_real_time(Link& link, Schedule& schedule, observe::TargetWatch& watch,
                     std::int64_t silence_limit_ns, const std::atomic<bool>& stop, const Progress& progress,
                     std::int64_t spin_ns, const Gone& gone) {
  const std::int64_t start_ns = link.now_ns() + lead_ns;
  const auto bench_us = [&](std::int64_t t_ns) { return (t_ns - start_ns) / ns_per_us; };
  const Attached attached(link, watch);
  std::int64_t heard_ns = start_ns;
  observe::BusWatch bus(link.port());
  const Attached bus_attached(link, bus);
  std::int64_t progress_due_us = 0;

  // The target's silence has no meaning while the bus is down or a fault stops the target. After that,
  // the usual limit of silence begins anew.
  const auto excused_until_ns = [&] {
    if (watch.heard()) heard_ns = link.now_ns();
    if (bus.outage()) return bus.outage()->since_ns + outage_limit_ns;
    const std::int64_t held_us = schedule.silent_until_us();
    const std::int64_t held_ns = held_us < 0 ? 0 : start_ns + held_us * ns_per_us;
    return std::max({heard_ns, bus.ended_ns(), held_ns}) + silence_limit_ns;
  };
  const auto silent = [&] {
    const std::int64_t since_us = bench_us(bus.outage() ? bus.outage()->since_ns : heard_ns);
    return Ending{bus.outage() ? Ending::Kind::bus_down : Ending::Kind::target_silent, since_us,
                  fmt::format("{} since t={:.3f} s", bus.outage() ? bus.outage()->what : "target silent",
                              static_cast<double>(since_us) * 1e-6)};
  };
  // Receives frames until `deadline_ns`; if the run is over, returns the reason.
  const auto receive_until = [&](const auto& deadline) -> std::optional<Ending> {
    for (;;) {
      const LinkState state = link.drain();
      const std::int64_t now = link.now_ns(), deadline_ns = deadline();
      if (state == LinkState::down) return Ending{Ending::Kind::bus_down, bench_us(now), "the bus is gone"};
      if (stop) return Ending{Ending::Kind::interrupted, bench_us(now), "interrupted"};
      if (auto fault = watch.fault()) return Ending{Ending::Kind::target_fault, bench_us(now), *fault};
      if (const auto why = gone()) return gone_at(bench_us(now), *why);
      if (now > excused_until_ns()) return silent();
      if (now >= deadline_ns) return std::nullopt;
      if (now >= deadline_ns - spin_ns) continue;
      const bool heard = link.wait_until(std::min(deadline_ns - spin_ns, excused_until_ns() + 1));
      if (!heard && link.now_ns() >= deadline_ns) return std::nullopt;  // on time, nothing to process
    }
  };
  // A frame that arrives may make the next transmission due earlier.
  const auto next_due_ns = [&] { return start_ns + schedule.due_us() * ns_per_us; };
  schedule.set_clock([&] { return bench_us(link.now_ns()); });

  while (schedule.due_us() != nodes::never_us) {
    if (auto ending = receive_until(next_due_ns)) return *ending;
    const std::int64_t due_us = schedule.due_us();
    const std::int64_t due_ns = start_ns + due_us * ns_per_us;
    const auto frames = schedule.take();
    if (const auto why = schedule.why_failed()) return gone_at(due_us, *why);
    for (const Frame& frame : frames) {
      LinkState state = link.send(frame, silence_limit_ns, due_ns);
      while (state != LinkState::up && bus.outage() && !stop && !link.port().closed()) {
        if (link.now_ns() > excused_until_ns()) return silent();
        state = link.send(frame, silence_limit_ns, due_ns);
      }
      switch (state) {
        case LinkState::up:
          break;
        case LinkState::congested:
          if (link.now_ns() > excused_until_ns()) {  // a target that no longer reads fills the bus
            Ending ending = silent();
            ending.detail += ", " + took_none(link, due_us);
            return ending;
          }
          return {Ending::Kind::target_silent, due_us, took_none(link, due_us)};
        case LinkState::down:
          return {Ending::Kind::bus_down, due_us, "the bus is down"};
      }
    }
    if (due_us >= progress_due_us) {
      progress(due_us);
      progress_due_us = due_us + progress_period_us;
    }
  }
  schedule.set_clock({});
  const std::int64_t end_ns = link.now_ns();
  if (auto ending = receive_until([&] { return end_ns + last_answers_ns; })) return *ending;
  return {Ending::Kind::completed, bench_us(end_ns), ""};
}

}  // namespace canhil::drive
