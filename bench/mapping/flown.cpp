#include "bench/mapping/flown.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/mapping/conversation.hpp"
#include "bench/mapping/player.hpp"

namespace canhil::mapping {
namespace {

// The first values of each signal, for the noise.
constexpr std::size_t most_values = 20'000;
using ValueSeries = std::map<const Source*, std::vector<double>>;

// Plays a run, and adds its values to the ranges.
ValueSeries played(const Mapping& mapping, const sensors::Run& run, FlownValues& flown) {
  ValueSeries series;
  Conversation conversation(mapping);
  conversation.on_value = [&](const Source& source, double value) {
    PlayedValues& own = flown[&source];
    own.lowest = std::min(own.lowest, value);
    own.highest = std::max(own.highest, value);
    if (auto& values = series[&source]; values.size() < most_values) values.push_back(value);
  };
  Player player(conversation, run);
  for (nodes::Transmission out; player.due_us() != nodes::never_us; out.clear()) player.transmit(out);
  return series;
}

// `turn`: the values come round; 0: they do not.
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

FlownValues flown_values(const Mapping& mapping, const sensors::Run& one, const sensors::Run& other) {
  FlownValues flown;
  const ValueSeries first = played(mapping, one, flown), second = played(mapping, other, flown);
  for (const auto& [source, values] : first) {
    const auto found = second.find(source);
    if (source->measurand == nullptr || found == second.end()) continue;
    const double turn =
        source->measurand->output().turns ? 2 * std::numbers::pi * std::abs(source->factor) : 0;
    flown[source].noise = white_noise(values, found->second, turn);
  }
  return flown;
}

}  // namespace canhil::mapping
