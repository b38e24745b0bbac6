#include "bench/scenario/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/world/units.hpp"

namespace canhil::scenario {
namespace {

struct Unit {
  std::string_view ending;
  double factor;
};

}  // namespace

double factor_of(std::string_view key) {
  namespace units = world::units;
  static constexpr std::array table{Unit{"_deg", units::deg},
                                    Unit{"_mrad", units::mrad},
                                    Unit{"_mradps", units::mrad},
                                    Unit{"_kmph", units::kmph},
                                    Unit{"_degph", units::degph},
                                    Unit{"_degps", units::deg},
                                    Unit{"_degprth", units::degprth},
                                    Unit{"_ug", units::ug},
                                    Unit{"_ugprthz", units::ugprthz},
                                    Unit{"_g", units::standard_gravity},
                                    Unit{"_ppm", units::ppm},
                                    Unit{"_percent", 0.01},
                                    Unit{"_ms", 1e-3},
                                    Unit{"_us", 1e-6}};
  const auto* const unit =
      std::ranges::find_if(table, [&](const Unit& candidate) { return key.ends_with(candidate.ending); });
  return unit == table.end() ? 1.0 : unit->factor;
}

std::string description(const Limits& limits, std::string_view noun) {
  if (!std::isfinite(limits.least)) return std::string(noun);
  if (!std::isfinite(limits.most)) {
    return fmt::format("{} {} {}", noun, limits.above_least ? "above" : "of at least", limits.least);
  }
  if (limits.above_least) return fmt::format("{} above {}, at most {}", noun, limits.least, limits.most);
  return fmt::format("{} from {} to {}", noun, limits.least, limits.most);
}

bool holds(const Limits& limits, double value) {
  return std::isfinite(value) && value <= limits.most &&
         (limits.above_least ? value > limits.least : value >= limits.least);
}

}  // namespace canhil::scenario
