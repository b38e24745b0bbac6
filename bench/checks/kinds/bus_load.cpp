#include "bench/checks/kinds/bus_load.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/checks/bus_load.hpp"
#include "bench/checks/evidence.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {
namespace {

// The data rate matters only if FD frames were sent. If no data rate is given, FD frames use the nominal
// rate.
bool equally_fast(const wire::BitRates& a, const wire::BitRates& b, const Observations& seen) {
  const auto data = [](const wire::BitRates& rates) { return rates.data > 0 ? rates.data : rates.nominal; };
  const bool fd = std::ranges::any_of(seen.length_by_second,
                                      [](const wire::BitLength& second) { return second.data > 0; });
  return a.nominal == b.nominal && (!fd || data(a) == data(b));
}

}  // namespace

BusLoad BusLoad::read(scenario::Section& section, const scenario::CheckContext& /*context*/) {
  using scenario::Limits;
  BusLoad rule;
  constexpr std::int64_t kilo = 1000;
  constexpr std::int64_t fastest = 1000, fastest_data = 8000;  // ISO 11898-2
  rule.bitrate =
      section.integer(
          {"bitrate_kbitps", fmt::format("Bit rate for which the load is computed, at most {}.", fastest)},
          1) *
      kilo;
  if (rule.bitrate > fastest * kilo)
    section.reject("bitrate_kbitps", "is faster than CAN", fmt::format("kbit/s, at most {}", fastest));
  rule.data_bitrate =
      section
          .optional_integer({"data_bitrate_kbitps",
                             fmt::format("Bit rate of the data phase of CAN FD frames, from `bitrate_kbitps` "
                                         "to {}. Default: the value of `bitrate_kbitps`.",
                                         fastest_data)},
                            1)
          .value_or(0) *
      kilo;
  if (rule.data_bitrate != 0 &&
      (rule.data_bitrate < rule.bitrate || rule.data_bitrate > fastest_data * kilo)) {
    section.reject("data_bitrate_kbitps", fmt::format("is {}", rule.data_bitrate / kilo),
                   fmt::format("from bitrate_kbitps to {}", fastest_data));
  }
  rule.below =
      section.plain_number({"below_percent", "The load of each whole second must be below this value."},
                           Limits::above(0, 100)) /
      100;
  return rule;
}

std::string BusLoad::subject() const {
  return fmt::format("at {}", to_text({.nominal = bitrate, .data = data_bitrate}));
}

Finding BusLoad::judge(const Evidence& evidence) const {
  const Observations& seen = evidence.seen;
  std::vector<wire::BitRates> buses{{.nominal = bitrate, .data = data_bitrate}};
  // If the run's own bus is slower than the bus of the rule, the run's bus may be full although a bus with
  // the rates of the rule would not be full.
  if (seen.bit_rates.nominal > 0 && !equally_fast(seen.bit_rates, buses.front(), seen))
    buses.push_back(seen.bit_rates);
  constexpr double percent = 100;
  Finding finding{.outcome = Outcome::pass, .measured = {}, .expected = {}};
  Load highest;
  for (const wire::BitRates& rates : buses) {
    const Load load = bus_load(seen, rates);
    if (load.busiest > highest.busiest) highest = load;
    if (!(load.busiest > 0 && load.busiest < below)) finding.outcome = Outcome::fail;
    if (!finding.measured.empty())
      finding.measured += fmt::format("; at the {} of this run's bus ", to_text(rates));
    finding.measured += fmt::format("{:.1f} % in the busiest second, {:.1f} % in the mean",
                                    load.busiest * percent, load.mean * percent);
  }
  finding.expected = {.text = fmt::format("< {:g} % of {}", below * percent, to_text(buses.front())),
                      .criterion = {.quantity = "bus load",
                                    .statistic = "busiest second",
                                    .upper = exclusive(below * percent),
                                    .unit = "%"}};
  if (buses.size() > 1) finding.expected.text += ", and of this run's bus";
  if (const std::size_t count = whole_seconds(seen).size(); count > 0)
    finding.measurement = {.value = highest.busiest * percent,
                           .count = count,
                           .worst_at_us = highest.busiest_second * 1'000'000};
  return finding;
}

}  // namespace canhil::checks
