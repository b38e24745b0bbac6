// The scenario of docs/examples/autopilot with another plant.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/own_folder.hpp"
#include "tests/processes/hil/program.hpp"

namespace canhil::test {

inline const std::string autopilot_folder = SOURCE_DIR "/docs/examples/autopilot/";
inline const std::string steered_by_autopilot =
    "--target '/usr/bin/python3 " SOURCE_DIR "/docs/examples/autopilot/autopilot.py'";

/// Writes the scenario of the example, without the offset of the actuator, to a file, and returns its path.
/// `plant`: the keys of the table [plant]; the default is the plant that is built in. `rudder`: the output
/// that is the angle of the rudder.
inline std::string autopilot_loop(const std::string& name, const std::string& plant = "",
                                  const std::string& rudder = "rudder") {
  std::string text = read(autopilot_folder + "autopilot.toml");
  const auto change = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  change("actuator_offset_deg = 4\n", "");
  change("autopilot.mapping.toml", autopilot_folder + "autopilot.mapping.toml");
  change("\"plant.rudder\"", "\"plant." + rudder + "\"");
  if (!plant.empty()) {
    const std::size_t from = text.find("kind = \"steered_heading\""),
                      to = text.find("[plant.commands.rudder]");
    text.replace(from, to - from, plant);
  }
  std::ofstream(own_folder() + "/" + name) << text;
  return own_folder() + "/" + name;
}

/// The true heading [rad] at each step of the plant, from the table that --csv wrote.
inline std::vector<double> headings_of(const std::string& csv) {
  std::vector<double> all;
  std::istringstream lines(read(csv));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("plant,plant.attitude.heading,rad,,");
    if (at != std::string::npos) all.push_back(std::stod(line.substr(at + 34)));
  }
  return all;
}

/// Flies these scenarios in lockstep, expects that the first two turn alike to rounding, and returns the
/// headings of each [rad].
inline std::vector<std::vector<double>> fly_alike(const std::vector<std::string>& scenarios) {
  std::vector<std::vector<double>> flown;
  for (const std::string& scenario : scenarios) {
    const std::string csv = scratch("flown.csv");
    const Ended ended =
        hil_bench(fmt::format("run {} --lockstep {} --csv {}", scenario, steered_by_autopilot, csv));
    EXPECT_EQ(ended.code, 3) << ended.out << ended.err;
    flown.push_back(headings_of(csv));
    EXPECT_EQ(flown.back().size(), 3001U);
  }
  for (std::size_t i = 0; i < std::min(flown[0].size(), flown[1].size()); ++i)
    EXPECT_NEAR(flown[0][i], flown[1][i], 1e-10) << i;
  return flown;
}

}  // namespace canhil::test
