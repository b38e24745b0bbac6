#include "bench/drive/stimuli.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "bench/drive/dialect.hpp"
#include "bench/mapping/conversation.hpp"
#include "bench/mapping/player.hpp"
#include "bench/scenario/binding.hpp"

namespace canhil::drive {

Result<void> check_stimuli(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index, const std::atomic<bool>& stop) {
  if (scenario.engagement && scenario.engagement->guidance == world::Guidance::target) return {};
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

namespace {

// The first values of each signal, for the noise.
constexpr std::size_t most_values = 20'000;
using Series = std::map<const mapping::Source*, std::vector<double>>;

// Plays a run without a bus.
Result<Series> play(const scenario::Scenario& scenario, const mapping::Mapping& mapping,
                    const world::FlightRecord& truth, std::uint64_t run_index, mapping::FlownValues& flown) {
  auto flight = make_flight(scenario, truth, run_index);
  if (!flight) return tl::unexpected(flight.error());
  Series series;
  mapping::Conversation conversation(mapping);
  conversation.on_value = [&](const mapping::Source& source, double value) {
    mapping::PlayedValues& own = flown[&source];
    own.lowest = std::min(own.lowest, value);
    own.highest = std::max(own.highest, value);
    if (auto& values = series[&source]; values.size() < most_values) values.push_back(value);
  };
  PerRunTruth& own = flight->per_run_truth;
  mapping::Player player(conversation, nodes::Run{.scenario = scenario,
                                                  .index = run_index,
                                                  .flight = truth,
                                                  .glide = own.glide ? &*own.glide : nullptr,
                                                  .engagement = own.engagement ? &*own.engagement : nullptr});
  for (nodes::Transmission out; player.due_us() != nodes::never_us; out.clear()) player.transmit(out);
  return series;
}

// The sigma of white noise in the difference of two series: the differences d of neighbours have the variance
// 2 (sigma_a^2 + sigma_b^2), and what changes slowly in them is small.
double white_noise(const std::vector<double>& a, const std::vector<double>& b, double turn) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 1; i < std::min(a.size(), b.size()); ++i) {
    double change = (a[i] - b[i]) - (a[i - 1] - b[i - 1]);
    if (turn > 0) change = std::remainder(change, turn);
    sum += change * change;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count)) / 2;
}

}  // namespace

Result<mapping::FlownValues> flown_values(const scenario::Scenario& scenario,
                                          const mapping::Mapping& mapping) {
  scenario::Scenario undisturbed = scenario;
  undisturbed.faults.clear();
  const auto truth = make_truth(undisturbed);
  if (!truth) return tl::unexpected(truth.error());
  mapping::FlownValues flown;
  const auto one = play(undisturbed, mapping, *truth, 0, flown),
             other = play(undisturbed, mapping, *truth, 1, flown);
  if (!one) return tl::unexpected(one.error());
  if (!other) return tl::unexpected(other.error());
  for (const auto& [source, values] : *one) {
    if (source->measurand == nullptr) continue;
    const bool turns = source->measurand->output().turns;
    flown[source].noise =
        white_noise(values, other->at(source), turns ? 2 * std::numbers::pi * std::abs(source->factor) : 0);
  }
  return flown;
}

}  // namespace canhil::drive
