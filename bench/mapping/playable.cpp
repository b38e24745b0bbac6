#include "bench/mapping/playable.hpp"

#include <algorithm>

#include "bench/scenario/sensor_name.hpp"
#include "bench/sensors/registry.hpp"

namespace canhil::mapping {

Playable::Playable(std::optional<scenario::Section> section) {
  std::vector<std::string> kinds;
  for (const sensors::Kind* kind : sensors::all()) kinds.emplace_back(kind->key);
  for (const std::string& name : section ? section->keys() : std::vector<std::string>{}) {
    const std::string kind = section->one_of(name, kinds);
    if (const std::string why = scenario::why_no_name(name, kinds); !why.empty())
      section->reject(name, why, scenario::own_name);
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
