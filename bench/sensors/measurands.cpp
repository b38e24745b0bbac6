#include "bench/sensors/measurands.hpp"

#include <map>
#include <mutex>
#include <vector>

#include "bench/sensors/registry.hpp"

namespace canhil::sensors {
namespace {

// The name of a rate: "imu.rate.z", or with the name of a named sensor.
std::string rate_of(const Kind& sensor, const Output& output) {
  if (sensor.of == nullptr) return std::string(output.rate);
  return std::string(sensor.key) + std::string(output.rate.substr(output.rate.find('.')));
}

std::vector<Measurand> all_of(const Kind& sensor) {
  std::vector<Measurand> measurands;
  for (std::size_t i = 0; i < sensor.outputs.values.size(); ++i) {
    const Output& output = sensor.outputs.values[i];
    if (output.si.empty()) continue;
    const bool adds_up = !output.rate.empty();
    measurands.push_back({.name = std::string(sensor.key) + "." + std::string(output.name),
                          .si = output.si == plain_number ? "" : output.si,
                          .sensor = &sensor,
                          .index = i,
                          .over = adds_up ? Over::sum : Over::newest});
    if (!adds_up) continue;
    measurands.push_back({.name = rate_of(sensor, output),
                          .si = output.si == "rad" ? "rad/s" : "m/s^2",
                          .sensor = &sensor,
                          .index = i,
                          .over = Over::rate});
  }
  return measurands;
}

}  // namespace

std::span<const Measurand> measurands_of(const Kind& sensor) {
  static std::mutex mutex;
  static std::map<const Kind*, std::vector<Measurand>> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(&sensor);
  return found != known.end() ? found->second : known.emplace(&sensor, all_of(sensor)).first->second;
}

std::span<const Measurand> measurands() {
  static const std::vector<Measurand> all = [] {
    std::vector<Measurand> measurands;
    for (const Kind* kind : sensors::all()) {
      const auto own = measurands_of(*kind);
      measurands.insert(measurands.end(), own.begin(), own.end());
    }
    return measurands;
  }();
  return all;
}

}  // namespace canhil::sensors
