#include "bench/drive/lockstep.hpp"

#include <fmt/format.h>

#include "bench/observe/heard.hpp"
#include "bench/observe/heartbeat_errors.hpp"
#include "bench/observe/second_target.hpp"
#include "messages/canhil.hpp"

namespace canhil::drive {
namespace {

// The end of a step as the target sees it.
class StepWatch final : public observe::Observer {
 public:
  void await(std::uint16_t step) {
    awaited_ = step;
    done_ = false;
  }
  void received(const Received& received) override {
    if (const auto done = observe::heard<messages::StepDone>(received))
      done_ = done_ || done->step == awaited_;
    if (const auto beat = observe::fault_in(received)) fault_ = beat;
  }
  [[nodiscard]] std::uint16_t awaited() const { return awaited_; }
  [[nodiscard]] bool done() const { return done_; }
  /// The heartbeat that said so.
  [[nodiscard]] const std::optional<messages::TargetHeartbeat>& fault() const { return fault_; }

 private:
  std::uint16_t awaited_ = 0;
  bool done_ = false;
  std::optional<messages::TargetHeartbeat> fault_;
};

}  // namespace

Ending run_lockstep(Link& link, Schedule& schedule, std::int64_t step_limit_ns, const std::atomic<bool>& stop,
                    const Progress& progress) {
  StepWatch watch;
  const Attached attached(link, watch);
  observe::SecondTarget second;
  // With the device at the port's other end nobody else can be there: a campaign need not look for him.
  std::optional<Attached> second_attached;
  if (!link.port().capabilities().in_process) second_attached.emplace(link, second);
  std::int64_t progress_due_us = 0;
  std::int64_t t_us = 0;
  constexpr std::int64_t progress_period_us = 1'000'000;

  while (schedule.due_us() != nodes::never_us) {
    t_us = schedule.due_us();
    link.tell_time(t_us * 1000);
    if (t_us >= progress_due_us) {
      progress(t_us);
      progress_due_us = t_us + progress_period_us;
    }
    bool closes_step = false;
    for (const Frame& frame : schedule.take()) {
      if (frame.id == messages::Sync::info.id) {
        closes_step = true;
        watch.await(from_frame<messages::Sync>(frame).step);
      }
      if (link.send(frame, step_limit_ns) != LinkState::up) {
        return {Ending::Kind::bus_down, t_us,
                fmt::format("the bus took no frame at t={:.3f} s", static_cast<double>(t_us) * 1e-6)};
      }
    }
    if (!closes_step) continue;
    std::int64_t deadline_ns = 0;  // from the first wait on: a target in this process has answered already
    while (!watch.done()) {
      if (link.drain() == LinkState::down) {
        return {Ending::Kind::bus_down, t_us, "the bus is gone"};
      }
      if (watch.done()) break;
      if (stop) return {Ending::Kind::interrupted, t_us, "interrupted"};
      const std::int64_t now = clock_ns(CLOCK_MONOTONIC);
      if (deadline_ns == 0) deadline_ns = now + step_limit_ns;
      if (now > deadline_ns) {
        return {Ending::Kind::target_silent, t_us,
                fmt::format("target silent since t={:.3f} s: step {} was not answered",
                            static_cast<double>(t_us) * 1e-6, watch.awaited())};
      }
      link.wait_until(deadline_ns);
    }
    if (second.found())
      return {Ending::Kind::target_fault, t_us, std::string(observe::SecondTarget::complaint)};
    if (watch.fault()) return {Ending::Kind::target_fault, t_us, observe::fault_of(*watch.fault())};
  }
  return {Ending::Kind::completed, t_us, ""};
}

}  // namespace canhil::drive
