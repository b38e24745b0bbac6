#include "bench/sensors/measurands.hpp"

#include <algorithm>
#include <vector>

#include "bench/sensors/registry.hpp"

namespace canhil::sensors {
namespace {

std::vector<Measurand> all_measurands() {
  std::vector<Measurand> measurands;
  for (const Kind* kind : all()) {
    for (std::size_t i = 0; i < kind->outputs.values.size(); ++i) {
      const Output& output = kind->outputs.values[i];
      if (output.si.empty()) continue;
      const bool adds_up = !output.rate.empty();
      measurands.push_back({.name = std::string(kind->key) + "." + std::string(output.name),
                            .si = output.si,
                            .sensor = kind,
                            .index = i,
                            .over = adds_up ? Over::sum : Over::newest});
      if (!adds_up) continue;
      measurands.push_back({.name = std::string(output.rate),
                            .si = output.si == "rad" ? "rad/s" : "m/s^2",
                            .sensor = kind,
                            .index = i,
                            .over = Over::rate});
    }
  }
  return measurands;
}

}  // namespace

std::span<const Measurand> measurands() {
  static const std::vector<Measurand> all = all_measurands();
  return all;
}

const Measurand* find_measurand(std::string_view name) {
  const auto found = std::ranges::find(measurands(), name, &Measurand::name);
  return found == measurands().end() ? nullptr : &*found;
}

}  // namespace canhil::sensors
