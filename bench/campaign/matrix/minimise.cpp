#include "bench/campaign/matrix/minimise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/campaign/matrix/delta.hpp"

namespace canhil::campaign::matrix {
namespace {

constexpr std::int64_t flight_step_us = 100'000, window_step_us = 10'000;
constexpr std::int64_t most_sparse = 1024;

std::int64_t time_us(const FaultText& fault, std::string_view key, std::int64_t otherwise) {
  const scenario::Setting* found = fault.find(key);
  return found == nullptr ? otherwise : std::llround(std::strtod(found->value.c_str(), nullptr) * 1e6);
}

std::string seconds(std::int64_t t_us) { return fmt::format("{:.3f}", static_cast<double>(t_us) * 1e-6); }

}  // namespace

Minimised minimise(const std::vector<FaultText>& faults, std::int64_t flown_us, const Shows& shows) {
  Minimised least{.faults = faults};
  // A flight that ended early is shortened until it completes, because only completed flights are judged.
  const std::int64_t whole_us = flown_us / flight_step_us * flight_step_us;
  if (!shows(faults, 0)) {
    for (std::int64_t back_us = 0; back_us < 5 * flight_step_us && least.duration_us == 0;
         back_us += flight_step_us) {
      const std::int64_t cut_us = whole_us - back_us;
      if (cut_us > 0 && shows(faults, cut_us)) least.duration_us = cut_us;
    }
    if (least.duration_us == 0) return least;  // no completed flight shows the violation
  }
  least.faults = least_of<FaultText>(
      faults, [&](const std::vector<FaultText>& some) { return shows(some, least.duration_us); });

  const std::int64_t most_us = least.duration_us == 0 ? whole_us : least.duration_us;
  const auto [begin, shortest_us] =
      least_stretch(0, most_us, flight_step_us, [&](std::int64_t from_us, std::int64_t to_us) {
        return from_us == 0 && to_us > 0 && shows(least.faults, to_us);
      });
  if (shortest_us != most_us || least.duration_us != 0) least.duration_us = shortest_us;

  for (std::size_t index = 0; index < least.faults.size(); ++index) {
    const auto with = [&](FaultText fault) {
      std::vector<FaultText> all = least.faults;
      all[index] = std::move(fault);
      return all;
    };
    const auto within = [&](std::int64_t from_us, std::int64_t to_us) {
      FaultText fault = least.faults[index];
      fault.set("from_s", seconds(from_us));
      fault.set("to_s", seconds(to_us));
      return fault;
    };
    const std::int64_t from_us = time_us(least.faults[index], "from_s", 0);
    const std::int64_t to_us =
        std::min(time_us(least.faults[index], "to_s", shortest_us), std::max(shortest_us, from_us));
    if (shows(with(within(from_us, to_us)), least.duration_us)) {
      const auto [first_us, last_us] =
          least_stretch(from_us, to_us, window_step_us, [&](std::int64_t a_us, std::int64_t b_us) {
            return shows(with(within(a_us, b_us)), least.duration_us);
          });
      least.faults[index] = within(first_us, last_us);
    }
    const FaultText dense = least.faults[index];
    const scenario::Setting* given = dense.find("every");
    std::int64_t every = given == nullptr ? 1 : std::atoll(given->value.c_str());
    for (; every < most_sparse; every *= 2) {
      FaultText sparser = least.faults[index];
      sparser.set("every", std::to_string(2 * every));
      if (!shows(with(sparser), least.duration_us)) break;
      least.faults[index] = std::move(sparser);
    }
    if (every >= most_sparse) least.faults[index] = dense;  // one frame suffices: restore `every`
  }
  return least;
}

}  // namespace canhil::campaign::matrix
