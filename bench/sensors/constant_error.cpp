#include "bench/sensors/constant_error.hpp"

#include <fmt/format.h>

#include <string>

namespace canhil::sensors {
namespace {

using scenario::Limits;

// "bias_m" -> "bias_sigma_m", "bias" -> "bias_sigma".
std::string sigma_of(std::string_view key) {
  const std::string_view unit = scenario::ending_of(key);
  return fmt::format("{}_sigma{}", key.substr(0, key.size() - unit.size()), unit);
}
std::string constant_of(std::string_view of) { return fmt::format("Constant error of {}.", of); }
std::string drawn_of(std::string_view of) {
  return fmt::format("1-sigma of a further constant error of {}, drawn for each run and added.", of);
}

}  // namespace

world::RandomValue read_constant(scenario::Section& section, std::string_view key, std::string_view of,
                                 double usual_sigma) {
  const std::string sigma = sigma_of(key), constant = constant_of(of), drawn = drawn_of(of);
  return {.value = section.number({key, constant}, Limits{}, 0),
          .sigma = section.number({sigma, drawn}, Limits::at_least(0), usual_sigma)};
}

world::RandomConstant read_constants(scenario::Section& section, std::string_view key, std::string_view of) {
  const std::string sigma = sigma_of(key), constant = constant_of(of), drawn = drawn_of(of);
  return {.value = section.three({key, constant}),
          .sigma = section.three({sigma, drawn}, Limits::at_least(0))};
}

world::RandomConstant read_mounting(scenario::Section& section, std::string_view of) {
  return read_constants(section, "mounting_deg",
                        fmt::format("the mounting of {}: roll, pitch and yaw of its axes in the body", of));
}

world::Vector3 read_lever_arm(scenario::Section& section, std::string_view what) {
  const std::string meaning = fmt::format("From the body's origin to {}, body axes [x, y, z].", what);
  return section.three({"lever_arm_m", meaning}, Limits::between(-1000, 1000));
}

}  // namespace canhil::sensors
