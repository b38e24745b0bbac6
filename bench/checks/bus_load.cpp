#include "bench/checks/bus_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace canhil::checks {

std::span<const wire::BitLength> whole_seconds(const Observations& seen) {
  const std::span<const wire::BitLength> seconds = seen.length_by_second;
  return seconds.size() > 1 ? seconds.first(seconds.size() - 1) : seconds;
}

BusLoad bus_load(const Observations& seen, wire::BitRates rates) {
  const std::span<const wire::BitLength> seconds = whole_seconds(seen);
  BusLoad load;
  for (const wire::BitLength& second : seconds) {
    const double share = wire::bus_load(second, 1.0, rates);
    load.mean += share / static_cast<double>(seconds.size());
    load.busiest = std::max(load.busiest, share);
  }
  return load;
}

Finding judge(const scenario::BusLoad& rule, const Observations& seen) {
  std::vector<wire::BitRates> buses{{.nominal = rule.bitrate, .data = rule.data_bitrate}};
  // A wire slower than the bus that the rule is about may be full where that bus would not be.
  if (seen.bit_rates.nominal > 0 && seen.bit_rates.nominal != rule.bitrate) buses.push_back(seen.bit_rates);
  Finding finding{.outcome = Outcome::pass, .measured = {}, .expected = {}};
  for (const wire::BitRates& rates : buses) {
    const BusLoad load = bus_load(seen, rates);
    if (!(load.busiest > 0 && load.busiest < rule.below)) finding.outcome = Outcome::fail;
    if (!finding.measured.empty())
      finding.measured +=
          fmt::format("; at the {:g} kbit/s of this run's bus ", static_cast<double>(rates.nominal) * 1e-3);
    finding.measured += fmt::format("{:.1f} % in the busiest second, {:.1f} % in the mean",
                                    load.busiest * 100, load.mean * 100);
  }
  finding.expected =
      fmt::format("< {:g} % of {:g} kbit/s", rule.below * 100, static_cast<double>(rule.bitrate) * 1e-3);
  if (buses.size() > 1) finding.expected += ", and of this run's bus";
  return finding;
}

}  // namespace canhil::checks
