// Samples of a sensor whose table is given as text, as in a scenario.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/nodes/registry.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::sensors {

/// `table`: the keys of the sensor's table.
inline std::vector<Sample> measured(const Kind& kind, const std::string& table,
                                    const world::FlightRecord& flight, std::uint64_t run = 0,
                                    const scenario::Scenario& scenario = {}) {
  auto section = scenario::Section::parse(table, "sensor.toml");
  const NodeSettings node = kind.read(nodes::bound(kind).table, section);
  section.finish();
  EXPECT_FALSE(section.error()) << section.error()->message;
  std::vector<Sample> all;
  if (section.error()) return all;
  const auto sensor = kind.make(node, {.scenario = scenario, .index = run, .flight = flight});
  while (sensor->due_us() != never_us) all.push_back(sensor->measure());
  return all;
}

/// The error of a table, as one line; empty: it has none.
inline std::string refusal_of(const Kind& kind, const std::string& table) {
  auto section = scenario::Section::parse(table, "sensor.toml");
  (void)kind.read(nodes::bound(kind).table, section);
  section.finish();
  return section.error() ? section.error()->message : "";
}

}  // namespace canhil::sensors
