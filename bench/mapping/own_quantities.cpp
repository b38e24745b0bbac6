#include "bench/mapping/own_quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <vector>

#include "bench/mapping/quantities.hpp"
#include "bench/quantities/wire_unit.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::mapping {
namespace {

using quantities::Quantity;
using quantities::Unit;

// The SI units, and the units in which reports show quantities of these.
constexpr std::array<std::pair<std::string_view, Unit>, 10> units{{{"rad", quantities::degrees},
                                                                   {"rad/s", quantities::degps},
                                                                   {"m/s^2", quantities::mps2},
                                                                   {"m/s", quantities::mps},
                                                                   {"m", quantities::metres},
                                                                   {"s", {"s", "_s"}},
                                                                   {"Pa", {"Pa", "_pa"}},
                                                                   {"K", {"K", "_k"}},
                                                                   {"T", {"T", "_t"}},
                                                                   {"1", quantities::plain}}};

bool is_name(std::string_view text) {
  return !text.empty() && text.find(".sigma") == std::string_view::npos &&
         std::ranges::all_of(text, [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
         });
}

// A quantity is identified by its address, so equal definitions in several mappings give one object.
const Quantity& interned(std::string_view name, std::string_view si) {
  struct Own {
    std::string name, meaning;
    std::string_view si;
    Quantity quantity{};
  };
  static std::mutex mutex;
  static std::deque<Own> known;
  const std::lock_guard lock(mutex);
  for (const Own& one : known) {
    if (one.name == name && one.si == si) return one.quantity;
  }
  Own& own = known.emplace_back(
      Own{.name = std::string(name), .meaning = fmt::format("error of {}", name), .si = si});
  const auto unit = std::ranges::find(units, si.empty() ? "1" : si, &decltype(units)::value_type::first);
  own.quantity = {.name = own.name, .meaning = own.meaning, .unit = unit->second};
  return own.quantity;
}

}  // namespace

namespace {

std::string_view read_si(scenario::Section& section, std::string_view key) {
  const std::string text = section.text(key);
  const auto found = std::ranges::find(units, std::string_view(text), &decltype(units)::value_type::first);
  if (found != units.end()) return found->first == "1" ? "" : found->first;
  std::vector<std::string_view> names;
  for (const auto& [si, unit] : units) names.push_back(si);
  if (!text.empty())
    section.reject(key, fmt::format("'{}' is not the SI unit of a quantity", text),
                   fmt::format("one of: {}", fmt::join(names, ", ")));
  return "";
}

}  // namespace

DeclaredUnit read_unit(scenario::Section& section) {
  const DeclaredUnit unit{.si = read_si(section, "unit"), .turns = section.flag("turns")};
  if (unit.turns && unit.si != "rad") section.reject("turns", "is for angles", "the unit rad");
  return unit;
}

DeclaredUnit read_unit(scenario::Section& section, std::string_view key) {
  if (section.holds_text(key)) return {.si = read_si(section, key)};
  scenario::Section table = section.table(key);
  const DeclaredUnit unit = read_unit(table);
  table.finish();
  return unit;
}

const ReferenceQuantity& add_command(std::deque<ReferenceQuantity>& own, std::string_view name,
                                     std::string_view si) {
  const bool known = std::ranges::find(units, si, &decltype(units)::value_type::first) != units.end();
  return own.emplace_back(
      ReferenceQuantity{.quantity = &interned(name, known ? si : ""), .si = known ? si : ""});
}

std::deque<ReferenceQuantity> read_own_quantities(scenario::Section& section) {
  std::deque<ReferenceQuantity> all;
  for (const std::string& name : section.keys()) {
    scenario::Section one = section.table(name);
    if (find_reference_quantity(name) != nullptr)
      section.reject(name, "is a quantity of the bench", "a name of its own");
    if (!is_name(name))
      section.reject(name, "is no name of a quantity", "a-z, 0-9, _ and '.', such as rudder.angle");
    const DeclaredUnit unit = read_unit(one);
    ReferenceQuantity& own = all.emplace_back(
        ReferenceQuantity{.quantity = &interned(name, unit.si), .si = unit.si, .turns = unit.turns});
    if (one.has("truth")) {
      if (auto truth = scenario::read_expression(one, "truth", "The true value.")) own.truth = *truth;
    }
    one.optional("truth");
    one.finish();
  }
  section.finish();
  return all;
}

}  // namespace canhil::mapping
