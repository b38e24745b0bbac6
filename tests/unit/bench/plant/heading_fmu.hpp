// The plant steered_heading as an FMU, from models/heading.c. Its parameters are in SI.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/unit/bench/plant/made_fmu.hpp"

namespace canhil::test {

inline std::string heading_description(int version, const std::string& model) {
  std::vector<Described> all{{"rudder", 0, "Float64", "input", "start='0' unit='rad'"}};
  int reference = 1;
  for (const char* name : {"heading", "speed", "time_constant", "gain", "lag", "rate_limit", "stop", "gust",
                           "gust_from", "gust_to"})
    all.push_back({name, reference++, "Float64", "parameter", "start='1'", "variability='fixed'"});
  reference = 20;
  for (const auto& [name, unit] :
       {std::pair("attitude.heading", "rad"), std::pair("velocity.north", "m/s"),
        std::pair("velocity.east", "m/s"), std::pair("turn_rate", "rad/s"), std::pair("rudder_angle", "rad")})
    all.push_back({name, reference++, "Float64", "output", fmt::format("unit='{}'", unit)});
  return description_of(version, model, all,
                        "<UnitDefinitions><Unit name='rad'><BaseUnit rad='1'/></Unit>"
                        "<Unit name='rad/s'><BaseUnit rad='1' s='-1'/></Unit>"
                        "<Unit name='m/s'><BaseUnit m='1' s='-1'/></Unit></UnitDefinitions>");
}

}  // namespace canhil::test
