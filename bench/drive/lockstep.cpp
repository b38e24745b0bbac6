#include "bench/drive/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::drive {
namespace {

// How often a wait is left to look at `stop` and `gone`: a signal may reach another thread.
constexpr std::int64_t look_period_ns = 50'000'000;

Ending took_nothing(std::int64_t t_us) {
  return {Ending::Kind::bus_down, t_us,
          fmt::format("the bus accepted no frame at t={:.3f} s", static_cast<double>(t_us) * 1e-6)};
}

Ending run_steps(Link& link, Schedule& schedule, observe::TargetWatch& watch, std::int64_t step_limit_ns,
                 const std::atomic<bool>& stop, const Progress& progress, const Gone& gone) {
  std::int64_t progress_due_us = 0;
  std::int64_t t_us = 0;
  constexpr std::int64_t progress_period_us = 1'000'000;

  while (schedule.due_us() != nodes::never_us) {
    t_us = schedule.due_us();
    if (stop) return {Ending::Kind::interrupted, t_us, "interrupted"};
    link.set_time(t_us * 1000);
    if (t_us >= progress_due_us) {
      progress(t_us);
      progress_due_us = t_us + progress_period_us;
    }
    bool closes_step = false;
    const auto frames = schedule.take();
    if (const auto why = schedule.why_failed()) return gone_at(t_us, *why);  // its truth moves no more
    for (const Frame& frame : frames) closes_step = watch.closes_step(frame) || closes_step;
    if (link.post(frames, step_limit_ns) != LinkState::up) return took_nothing(t_us);
    // An answer to an event takes no virtual time, unless the bench must send a frame before it.
    const auto awaits_answer = [&] { return schedule.awaits() && schedule.due_us() > t_us; };
    if (!closes_step && !awaits_answer()) continue;
    if (link.flush(step_limit_ns) != LinkState::up) return took_nothing(t_us);
    std::int64_t deadline_ns = 0;  // set at the first wait; a target in this process has already answered
    bool woken = true;             // whether a target still lives costs a system call: asked if no frame came
    while (!watch.step_done() || awaits_answer()) {
      if (link.drain() == LinkState::down) {
        return {Ending::Kind::bus_down, t_us, "the bus is gone"};
      }
      if (watch.step_done() && !awaits_answer()) break;
      if (stop) return {Ending::Kind::interrupted, t_us, "interrupted"};
      if (const auto why = woken ? std::nullopt : gone()) return gone_at(t_us, *why);
      const std::int64_t now = clock_ns(CLOCK_MONOTONIC);
      if (deadline_ns == 0) deadline_ns = now + step_limit_ns;
      if (now > deadline_ns && watch.step_done()) {
        schedule.give_up();
        break;
      }
      if (now > deadline_ns) {
        return {Ending::Kind::target_silent, t_us,
                fmt::format("target silent since t={:.3f} s: {} was not answered",
                            static_cast<double>(t_us) * 1e-6, watch.step())};
      }
      woken = link.wait_until(std::min(deadline_ns, now + look_period_ns));
    }
    if (auto fault = watch.fault()) return {Ending::Kind::target_fault, t_us, *fault};
  }
  return {Ending::Kind::completed, t_us, ""};
}

}  // namespace

Ending run_lockstep(Link& link, Schedule& schedule, observe::TargetWatch& watch, std::int64_t step_limit_ns,
                    const std::atomic<bool>& stop, const Progress& progress, const Gone& gone) {
  const Attached attached(link, watch);
  Ending ending = run_steps(link, schedule, watch, step_limit_ns, stop, progress, gone);
  const bool sent = link.flush(step_limit_ns) == LinkState::up;  // what came after the last step
  if (ending.kind == Ending::Kind::completed && !sent) return took_nothing(ending.t_us);
  return ending;
}

}  // namespace canhil::drive
