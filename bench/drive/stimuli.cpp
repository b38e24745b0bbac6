#include "bench/drive/stimuli.hpp"

#include <algorithm>

#include "bench/drive/dialect.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::drive {

Result<void> check_stimuli(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index, const std::atomic<bool>& stop) {
  if (scenario.closes_the_loop()) return {};
  // A program computes its samples once, in the run, which reports what was clipped.
  if (std::ranges::any_of(scenario.nodes, &scenario::NodeSettings::is_program)) return {};
  scenario::Scenario undisturbed = scenario;
  undisturbed.faults.clear();
  undisturbed.events.clear();
  auto flight = make_flight(undisturbed, truth, run_index);
  if (!flight) return tl::unexpected(flight.error());
  const auto dialect =
      make_dialect({.scenario = undisturbed, .truth = truth, .flight = *flight, .run_index = run_index});
  if (!dialect) return {};  // the run itself reports this error
  const auto schedule = (*dialect)->schedule(
      std::make_unique<faults::Faults>(undisturbed, run_index, scenario.binding->messages));
  while (schedule->due_us() != nodes::never_us && !stop) {
    static_cast<void>(schedule->take());
    const nodes::Clipped& clipped = schedule->outbox().clipped();
    if (!clipped.empty()) return failure(clipped.to_text().front());
  }
  return {};
}

}  // namespace canhil::drive
