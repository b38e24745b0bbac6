// Flights against lying_target: a target that is correct except for one fault.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {

/// The path of a script that starts lying_target with this fault, for the option --target.
inline std::string liar(const std::string& lie) {
  std::string path = scratch(lie);
  std::ofstream(path) << fmt::format("#!/bin/sh\nexec {} {} \"$@\"\n", LYING_TARGET, lie);
  EXPECT_EQ(shell("chmod +x " + path).code, 0);
  return path;
}

/// The path of a copy of a scenario of bench/flights, with the text `more` appended.
inline std::string with(const std::string& flight, const std::string& more) {
  std::string path = scratch(flight + "_and_more.toml");
  std::ofstream(path) << read(scenario(flight)) << more;
  return path;
}

struct Flown {
  Ended ended;
  nlohmann::json report;
};
/// Runs a scenario; `more`: further arguments.
inline Flown fly(const std::string& file, const std::string& more, const std::string& clock = "--lockstep") {
  const std::string report = scratch("report.json");
  Flown flown{
      .ended = hil_bench(fmt::format("run {} --bus {} {} --json {} {}", file, bus(), clock, report, more)),
      .report = {}};
  EXPECT_NE(flown.ended.code, 2) << flown.ended.err;
  if (flown.ended.code != 2) flown.report = read_json(report);
  return flown;
}

/// The kinds of the checks that failed; each kind is listed once.
inline std::vector<std::string> failed(const nlohmann::json& report) {
  std::vector<std::string> kinds;
  for (const auto& check : report["checks"]) {
    if (check["outcome"] == "fail") kinds.push_back(check["kind"]);
  }
  kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
  return kinds;
}

/// A value of the first check of this kind: "measured", "outcome" ...
inline std::string of_check(const nlohmann::json& report, const std::string& kind, const std::string& key) {
  for (const auto& check : report["checks"]) {
    if (check["kind"] == kind) return check[key];
  }
  return "no such check";
}
inline std::string measured(const nlohmann::json& report, const std::string& kind) {
  return of_check(report, kind, "measured");
}

}  // namespace canhil::test
