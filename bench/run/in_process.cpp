#include "bench/run/in_process.hpp"

#include <atomic>

#include "bench/run/ears.hpp"
#include "bench/run/handshake.hpp"
#include "bench/run/in_process_port.hpp"
#include "bench/run/lockstep.hpp"
#include "bench/run/monitor.hpp"

namespace canhil::run {
namespace {

InProcessRun not_flown(const Error& why) {
  return {.ending = {.kind = Ending::Kind::not_flown, .t_us = 0, .detail = why.message}, .seen = {}};
}

}  // namespace

Result<InProcessRun> run_in_process(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                    std::uint64_t run_index, Rounding rounding) {
  constexpr std::int64_t step_limit_ns = 1'000'000'000;  // an answer is there when send() returns
  static const std::atomic<bool> never = false;
  auto own_truth = make_own_truth(scenario, run_index);
  if (!own_truth) return not_flown(own_truth.error());
  const auto initial = make_initial_states(scenario, truth, *own_truth, run_index);
  if (!initial) return not_flown(initial.error());

  InProcessPort port(rounding);
  Link link(port);
  Schedule schedule = make_schedule(scenario, truth, *own_truth, run_index, true, rounding);
  const auto gone = []() -> std::optional<std::string> { return std::nullopt; };
  if (auto ready = configure(link, schedule.outbox(), scenario.targets, *initial, gone); !ready) {
    return tl::unexpected(ready.error());
  }
  Monitor monitor;
  const Attached attached(link, monitor);
  Ears ears(schedule);
  const Attached listening(link, ears);
  Ending ending = run_lockstep(link, schedule, step_limit_ns, never, [](std::int64_t) {});
  return InProcessRun{
      .ending = std::move(ending), .seen = monitor.finish(), .own_truth = std::move(*own_truth)};
}

}  // namespace canhil::run
