// Reads the table [plant] of a scenario, as the bench does.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/plant/registry.hpp"
#include "bench/scenario/section.hpp"
#include "tests/own_folder.hpp"

namespace canhil::plant {

struct PlanRead {
  std::unique_ptr<Plan> plan{};
  std::string error{};           ///< empty: none
  std::uint64_t files_hash = 0;  ///< of the files that belong to the scenario
};

/// `keys`: of the table [plant], and tables below it. The scenario file is in the test's own folder.
inline PlanRead read_plan(std::string_view kind, const std::string& keys) {
  auto root = scenario::Section::parse("[plant]\n" + keys, test::own_folder() + "/x.toml");
  scenario::Section section = root.table("plant");
  const auto known = std::ranges::find(kinds(), kind, &Kind::key);
  if (known == kinds().end()) return {.error = "no such kind"};
  PlanRead read{.plan = (*known)->read(section)};
  section.finish();
  if (const auto error = root.error()) read.error = error->message;
  read.files_hash = root.files_hash();
  return read;
}

inline std::unique_ptr<Plan> good_plan(std::string_view kind, const std::string& keys) {
  PlanRead read = read_plan(kind, keys);
  EXPECT_EQ(read.error, "");
  return std::move(read.plan);
}

inline std::unique_ptr<Plant> made(const Plan& plan, const Draw& draw = {}) {
  auto plant = plan.make(draw);
  EXPECT_TRUE(plant) << plant.error().message;
  return plant ? *std::move(plant) : nullptr;
}

inline std::vector<double> values(const Plant& plant) {
  const auto outputs = plant.outputs();
  return {outputs.begin(), outputs.end()};
}

}  // namespace canhil::plant
