#include "bench/checks/bus_load.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::checks {

std::span<const wire::BitLength> whole_seconds(std::span<const wire::BitLength> seconds) {
  return seconds.size() > 1 ? seconds.first(seconds.size() - 1) : seconds;
}

std::span<const wire::BitLength> whole_seconds(const Observations& seen) {
  return whole_seconds(seen.length_by_second);
}

LoadLine load_line(std::span<const wire::BitLength> seconds, wire::BitRates rates) {
  constexpr std::size_t most = 400;
  LoadLine line{.stretch_s = (seconds.size() + most - 1) / most};
  for (std::size_t from = 0; from < seconds.size(); from += line.stretch_s) {
    double busiest = 0;
    for (std::size_t i = from; i < std::min(seconds.size(), from + line.stretch_s); ++i)
      busiest = std::max(busiest, wire::bus_load(seconds[i], 1.0, rates));
    line.busiest.push_back(busiest);
  }
  return line;
}

Load bus_load(const Observations& seen, wire::BitRates rates) { return bus_load(whole_seconds(seen), rates); }

Load bus_load(std::span<const wire::BitLength> seconds, wire::BitRates rates) {
  Load load;
  std::int64_t index = 0;
  for (const wire::BitLength& second : seconds) {
    const double share = wire::bus_load(second, 1.0, rates);
    load.mean += share / static_cast<double>(seconds.size());
    if (share > load.busiest) {
      load.busiest = share;
      load.busiest_second = index;
    }
    ++index;
  }
  return load;
}

std::string to_text(const wire::BitRates& rates) {
  const auto kbit = [](std::int64_t rate) { return static_cast<double>(rate) * 1e-3; };
  const std::string data = rates.data > 0 ? fmt::format(" and {:g}", kbit(rates.data)) : "";
  return fmt::format("{:g}{} kbit/s", kbit(rates.nominal), data);
}

}  // namespace canhil::checks
