#include "bench/quantities/wire_unit.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "bench/world/units.hpp"

namespace canhil::quantities {
namespace {

using world::units::deg;
using world::units::kmph;
using world::units::standard_gravity;

constexpr double knot = 1852.0 / 3600;  // [m/s]
constexpr double gauss = 1e-4;          // [T]

constexpr std::array<std::pair<std::string_view, WireUnit>, 35> known{{
    {"rad", {"rad", 1}},
    {"mrad", {"rad", 1e-3}},
    {"deg", {"rad", deg}},
    {"rad/s", {"rad/s", 1}},
    {"mrad/s", {"rad/s", 1e-3}},
    {"deg/s", {"rad/s", deg}},
    {"dps", {"rad/s", deg}},
    {"m/s^2", {"m/s^2", 1}},
    {"g", {"m/s^2", standard_gravity}},
    {"mg", {"m/s^2", 1e-3 * standard_gravity}},
    {"m/s", {"m/s", 1}},
    {"cm/s", {"m/s", 1e-2}},
    {"mm/s", {"m/s", 1e-3}},
    {"km/h", {"m/s", kmph}},
    {"kn", {"m/s", knot}},
    {"m", {"m", 1}},
    {"cm", {"m", 1e-2}},
    {"mm", {"m", 1e-3}},
    {"km", {"m", 1e3}},
    {"ft", {"m", 0.3048}},
    {"s", {"s", 1}},
    {"ms", {"s", 1e-3}},
    {"us", {"s", 1e-6}},
    {"pa", {"Pa", 1}},
    {"hpa", {"Pa", 1e2}},
    {"kpa", {"Pa", 1e3}},
    {"mbar", {"Pa", 1e2}},
    {"bar", {"Pa", 1e5}},
    {"k", {"K", 1}},
    {"t", {"T", 1}},
    {"ut", {"T", 1e-6}},
    {"nt", {"T", 1e-9}},
    {"gauss", {"T", gauss}},
    {"mgauss", {"T", 1e-3 * gauss}},
    {"1", {"", 1}},
}};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Normalises the spelling of a unit, which varies between DBC files.
std::string plain(std::string_view text) {
  std::string unit(text);
  std::erase(unit, ' ');
  replace_all(unit, "\u00B0", "deg");  // degree sign
  replace_all(unit, "\u00BA", "deg");  // the ordinal indicator, often used as a degree sign
  replace_all(unit, "\u00B2", "^2");
  replace_all(unit, "\u00B5", "u");
  replace_all(unit, "**2", "^2");
  std::ranges::transform(unit, unit.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  replace_all(unit, "sec", "s");
  replace_all(unit, "degrees", "deg");
  replace_all(unit, "degree", "deg");
  replace_all(unit, "/s/s", "/s^2");
  if (unit.ends_with("/s2")) unit.insert(unit.size() - 1, "^");
  if (unit == "kph" || unit == "kmh") return "km/h";
  if (unit == "mps") return "m/s";
  return unit;
}

}  // namespace

std::optional<WireUnit> wire_unit(std::string_view text, std::string_view si) {
  std::string unit = plain(text);
  if (si == "T" && (unit == "g" || unit == "mg")) unit += "auss";
  const auto found =
      std::ranges::find(known, std::string_view(unit), &std::pair<std::string_view, WireUnit>::first);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

std::string wire_units(std::optional<std::string_view> si) {
  std::string all;
  for (const auto& [name, unit] : known) {
    if (!si || unit.si == *si) all += (all.empty() ? "" : ", ") + std::string(name);
  }
  return all;
}

}  // namespace canhil::quantities
