// Options that follow from a scenario, a bus or a target.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>

#include "bench/drive/session.hpp"
#include "bench/scenario/binding.hpp"
#include "dbc/ports/local_bus.hpp"

namespace canhil::drive {

BusFormat format_of(const scenario::Scenario& scenario) {
  if (scenario.binding->messages.front().fd) return BusFormat::fd_frames;
  return scenario.binding->containers && scenario.fd.value_or(false) ? BusFormat::fd : BusFormat::classic;
}

ClockKind clock_of(BusTime time, bool lockstep) {
  if (time == BusTime::waits) return ClockKind::simulated_wire;
  return lockstep || time == BusTime::set ? ClockKind::lockstep : ClockKind::real_time;
}

Options in_lockstep_against(std::string command) {
  static std::atomic<std::uint64_t> buses = 0;  // the number of the next bus: each flight has its own
  Options options;
  options.bus =
      BusName(named_local(std::string(local_prefix), fmt::format("canhil-{}-{}", getpid(), buses++)));
  options.targets = {std::move(command)};
  options.lockstep = true;
  options.offers_realtime = false;
  return options;
}

Options unattended(const std::string& target, const scenario::Scenario& scenario, Rounding rounding) {
  Options options;
  if (target.empty()) {
    options.bus = BusName(std::string(rounding == Rounding::none ? unrounded_bus : in_process_bus));
  } else {
    options = in_lockstep_against(target);
    // If answers do not name their cause, the bench cannot see when a step of virtual time is complete.
    options.lockstep = scenario.binding->answers_by_name;
  }
  options.format = format_of(scenario);
  return options;
}

}  // namespace canhil::drive
