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

std::string words(const wire::BitRates& rates) {
  const auto kbit = [](std::int64_t rate) { return static_cast<double>(rate) * 1e-3; };
  const std::string data = rates.data > 0 ? fmt::format(" and {:g}", kbit(rates.data)) : "";
  return fmt::format("{:g}{} kbit/s", kbit(rates.nominal), data);
}

namespace {

// A data rate counts where FD frames were sent; without one they are as fast as the nominal.
bool equally_fast(const wire::BitRates& a, const wire::BitRates& b, const Observations& seen) {
  const auto data = [](const wire::BitRates& rates) { return rates.data > 0 ? rates.data : rates.nominal; };
  const bool fd = std::ranges::any_of(seen.length_by_second,
                                      [](const wire::BitLength& second) { return second.data > 0; });
  return a.nominal == b.nominal && (!fd || data(a) == data(b));
}

}  // namespace

Finding judge(const scenario::BusLoad& rule, const Observations& seen) {
  std::vector<wire::BitRates> buses{{.nominal = rule.bitrate, .data = rule.data_bitrate}};
  // A wire slower than the bus that the rule is about may be full where that bus would not be.
  if (seen.bit_rates.nominal > 0 && !equally_fast(seen.bit_rates, buses.front(), seen))
    buses.push_back(seen.bit_rates);
  Finding finding{.outcome = Outcome::pass, .measured = {}, .expected = {}};
  for (const wire::BitRates& rates : buses) {
    const BusLoad load = bus_load(seen, rates);
    if (!(load.busiest > 0 && load.busiest < rule.below)) finding.outcome = Outcome::fail;
    if (!finding.measured.empty())
      finding.measured += fmt::format("; at the {} of this run's bus ", words(rates));
    finding.measured += fmt::format("{:.1f} % in the busiest second, {:.1f} % in the mean",
                                    load.busiest * 100, load.mean * 100);
  }
  finding.expected = fmt::format("< {:g} % of {}", rule.below * 100, words(buses.front()));
  if (buses.size() > 1) finding.expected += ", and of this run's bus";
  return finding;
}

}  // namespace canhil::checks
