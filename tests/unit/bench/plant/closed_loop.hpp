// A scenario whose plant an ECU steers. Its files are texts.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/bench/mapping/read_mapped.hpp"

namespace canhil::plant {

inline constexpr const char* ecu_dbc = R"(VERSION ""
BU_: Sensors ECU
BO_ 100 Heading: 4 Sensors
 SG_ Heading : 0|16@1+ (0.01,0) [0|360] "deg" ECU
 SG_ Count : 16|8@1+ (1,0) [0|255] "" ECU
BO_ 200 Rudder: 6 ECU
 SG_ Angle : 0|16@1- (0.01,0) [-90|90] "deg" Sensors
 SG_ On : 16|1@1+ (1,0) [0|1] "" Sensors
 SG_ Repeated : 24|8@1+ (1,0) [0|255] "" Sensors
 SG_ Flow : 32|8@1+ (1,0) [0|255] "m/s" Sensors
)";
inline constexpr const char* ecu_mapping = R"(
dbc = "ecu.dbc"
[[play]]
messages = ["Heading"]
every_ms = 20
[play.signals]
"Heading.Heading" = "master_ins.heading"
[[hear]]
message = "Rudder"
answers = "Heading"
echo = { signal = "Repeated", of = "Heading.Count" }
signals = { Angle = "rudder.command", Flow = "flow.command" }
[hear.flags]
On = "engaged"
[[protection]]
messages = ["Heading"]
counter = { signal = "Count" }
)";
inline constexpr const char* closed_loop = R"(title = "closed loop"
duration_s = 2.0
seed = 3
[target]
mapping = "ecu.mapping.toml"
[truth]
trajectory = "plant"
latitude_deg = 50
longitude_deg = 8
height_m = 100
[plant]
kind = "steered_heading"
heading_deg = 90
speed_mps = 10
turn_time_constant_s = 1
turn_gain_per_s = 1
[master_ins]
period_ms = 20
[[check]]
kind = "answers"
answers_at_least = 1
)";

inline Result<scenario::Scenario> read_loop(std::string_view scenario = closed_loop) {
  return mapping::read_mapped(scenario, ecu_mapping, ecu_dbc);
}

}  // namespace canhil::plant
