#include "bench/checks/bus_load.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  const BusLoad load = bus_load(seen, {.nominal = rule.bitrate, .data = rule.data_bitrate});
  Finding finding{.outcome = pass_if(load.busiest > 0 && load.busiest < rule.below),
                  .measured = fmt::format("{:.1f} % in the busiest second, {:.1f} % in the mean",
                                          load.busiest * 100, load.mean * 100),
                  .expected = fmt::format("< {:g} % of {:g} kbit/s", rule.below * 100,
                                          static_cast<double>(rule.bitrate) * 1e-3)};
  return finding;
}

}  // namespace canhil::checks
