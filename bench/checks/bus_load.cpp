#include "bench/checks/bus_load.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::checks {

std::span<const wire::BitLength> whole_seconds(const Observations& seen) {
  const std::span<const wire::BitLength> seconds = seen.length_by_second;
  return seconds.size() > 1 ? seconds.first(seconds.size() - 1) : seconds;
}

Load bus_load(const Observations& seen, wire::BitRates rates) {
  const std::span<const wire::BitLength> seconds = whole_seconds(seen);
  Load load;
  for (const wire::BitLength& second : seconds) {
    const double share = wire::bus_load(second, 1.0, rates);
    load.mean += share / static_cast<double>(seconds.size());
    load.busiest = std::max(load.busiest, share);
  }
  return load;
}

std::string to_text(const wire::BitRates& rates) {
  const auto kbit = [](std::int64_t rate) { return static_cast<double>(rate) * 1e-3; };
  const std::string data = rates.data > 0 ? fmt::format(" and {:g}", kbit(rates.data)) : "";
  return fmt::format("{:g}{} kbit/s", kbit(rates.nominal), data);
}

}  // namespace canhil::checks
