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
  std::string_view name;
};

namespace units = world::units;
// The first unit whose suffix matches is used.
constexpr std::array table{Unit{"_degph_per_g", units::degph / units::standard_gravity, "deg/h/g"},
                           Unit{"_degph_per_k", units::degph, "deg/h/K"},
                           Unit{"_degph_per_k2", units::degph, "deg/h/K^2"},
                           Unit{"_ug_per_k", units::ug, "ug/K"},
                           Unit{"_ug_per_k2", units::ug, "ug/K^2"},
                           Unit{"_ppm_per_k", units::ppm, "ppm/K"},
                           Unit{"_degphprth", units::degphprth, "deg/h/sqrt(h)"},
                           Unit{"_ugprth", units::ugprth, "ug/sqrt(h)"},
                           Unit{"_urad", units::urad, "urad"},
                           Unit{"_degc", 1, "degC"},
                           Unit{"_deg", units::deg, "deg"},
                           Unit{"_mrad", units::mrad, "mrad"},
                           Unit{"_mradps", units::mrad, "mrad/s"},
                           Unit{"_kmph", units::kmph, "km/h"},
                           Unit{"_degph", units::degph, "deg/h"},
                           Unit{"_degps", units::deg, "deg/s"},
                           Unit{"_degps2", units::deg, "deg/s^2"},
                           Unit{"_degprth", units::degprth, "deg/sqrt(h)"},
                           Unit{"_ug", units::ug, "ug"},
                           Unit{"_ugprthz", units::ugprthz, "ug/sqrt(Hz)"},
                           Unit{"_g2phz", units::standard_gravity* units::standard_gravity, "g^2/Hz"},
                           Unit{"_g", units::standard_gravity, "g"},
                           Unit{"_ppm", units::ppm, "ppm"},
                           Unit{"_hpa", 100, "hPa"},
                           Unit{"_pa", 1, "Pa"},
                           Unit{"_ut", 1e-6, "uT"},
                           Unit{"_t", 1, "T"},
                           Unit{"_k", 1, "K"},
                           Unit{"_percent", 0.01, "%"},
                           Unit{"_ms", 1e-3, "ms"},
                           Unit{"_us", 1e-6, "us"},
                           Unit{"_per_s", 1, "1/s"},
                           Unit{"_s", 1, "s"},
                           Unit{"_m", 1, "m"},
                           Unit{"_mps", 1, "m/s"},
                           Unit{"_mps2", 1, "m/s^2"},
                           Unit{"_rad", 1, "rad"},
                           Unit{"_radps", 1, "rad/s"},
                           Unit{"_radpm2", 1, "rad/m^2"},
                           Unit{"_hz", 1, "Hz"},
                           Unit{"_kbitps", 1, "kbit/s"},
                           Unit{"_m2ps", 1, "m^2/s"},
                           Unit{"_m2ps5", 1, "m^2/s^5"},
                           Unit{"_mprts", 1, "m/sqrt(s)"},
                           Unit{"_mpsprts", 1, "m/s/sqrt(s)"},
                           Unit{"_degprts", 1, "deg/sqrt(s)"},
                           Unit{"_degpsprts", 1, "deg/s/sqrt(s)"}};

const Unit* find_unit(std::string_view key) {
  const auto* const unit =
      std::ranges::find_if(table, [&](const Unit& candidate) { return key.ends_with(candidate.ending); });
  return unit == table.end() ? nullptr : unit;
}

}  // namespace

std::string_view ending_for(std::string_view si) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> endings{{{"rad", "_deg"},
                                                                                  {"rad/s", "_degps"},
                                                                                  {"m/s^2", "_mps2"},
                                                                                  {"m/s", "_mps"},
                                                                                  {"m", "_m"},
                                                                                  {"s", "_s"},
                                                                                  {"Pa", "_pa"},
                                                                                  {"K", "_k"},
                                                                                  {"T", "_t"}}};
  const auto found = std::ranges::find(endings, si, &decltype(endings)::value_type::first);
  return found == endings.end() ? "" : found->second;
}

std::string_view ending_of(std::string_view key) {
  const Unit* unit = find_unit(key);
  return unit == nullptr ? "" : unit->ending;
}

double factor_of(std::string_view key) {
  const Unit* unit = find_unit(key);
  return unit == nullptr ? 1.0 : unit->factor;
}

std::string_view unit_of(std::string_view key) {
  const Unit* unit = find_unit(key);
  return unit == nullptr ? "" : unit->name;
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
