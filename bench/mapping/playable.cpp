#include "bench/mapping/playable.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/mapping/own_quantities.hpp"
#include "bench/scenario/sensor_name.hpp"
#include "bench/sensors/registry.hpp"

namespace canhil::mapping {
namespace {

// A sensor whose values the mapping declares: `steering = { angle = "rad", course = { unit = "rad", turns =
// true } }`.
const sensors::Kind& read_generic(scenario::Section& section, const std::string& name) {
  std::vector<sensors::DeclaredValue> values;
  scenario::Section declared = section.table(name);
  for (const std::string& value : declared.keys()) {
    if (!scenario::is_name(value)) declared.reject(value, "is no name of a value", "a-z, 0-9 and _");
    const DeclaredUnit unit = read_unit(declared, value);
    values.push_back({.name = value, .si = unit.si, .turns = unit.turns});
  }
  if (values.empty() || values.size() > sensors::Sample::most_values)
    section.reject(name, fmt::format("has {} values", values.size()),
                   fmt::format("1 to {}, such as {{ angle = \"rad\" }}", sensors::Sample::most_values));
  values.resize(std::min(values.size(), sensors::Sample::most_values));
  declared.finish();
  return sensors::declared(name, values);
}

}  // namespace

Playable::Playable(std::optional<scenario::Section> section) {
  std::vector<std::string> kinds;
  for (const sensors::Kind* kind : sensors::all()) kinds.emplace_back(kind->key);
  for (const std::string& name : section ? section->keys() : std::vector<std::string>{}) {
    if (const std::string why = scenario::why_no_name(name, kinds); !why.empty())
      section->reject(name, why, scenario::own_name);
    if (!section->holds_text(name)) {
      named_.push_back(&read_generic(*section, name));
      continue;
    }
    const std::string kind = section->one_of(name, kinds);
    const auto found = std::ranges::find(sensors::all(), kind, &sensors::Kind::key);
    if (found != sensors::all().end()) named_.push_back(&sensors::named(**found, name));
  }
  if (section) section->finish();
  std::vector<const sensors::Kind*> every(sensors::all().begin(), sensors::all().end());
  every.insert(every.end(), named_.begin(), named_.end());
  for (const sensors::Kind* sensor : every) {
    for (const sensors::Measurand& one : sensors::measurands_of(*sensor)) all_.push_back(&one);
  }
}

const sensors::Measurand* Playable::find(std::string_view name) const {
  const auto found = std::ranges::find(all_, name, &sensors::Measurand::name);
  return found == all_.end() ? nullptr : *found;
}

std::vector<std::string_view> Playable::names() const {
  std::vector<std::string_view> names;
  for (const sensors::Measurand* one : all_) names.push_back(one->name);
  return names;
}

}  // namespace canhil::mapping
