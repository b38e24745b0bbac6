// A plant from the keys of its table [plant].
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "bench/plant/registry.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::plant {

/// Reads the keys of a kind. An error fails the test.
inline std::unique_ptr<Plan> plan_of(std::string_view kind, const std::string& keys) {
  scenario::Section section = scenario::Section::parse("[plant]\n" + keys, "p.toml").table("plant");
  std::unique_ptr<Plan> plan;
  for (const Kind* one : kinds()) {
    if (one->key == kind) plan = one->read(section);
  }
  section.finish();
  EXPECT_FALSE(section.error()) << section.error()->message;
  return plan;
}

inline std::unique_ptr<Plant> plant_of(const Plan& plan, const Draw& draw = {}) {
  auto plant = plan.make(draw);
  EXPECT_TRUE(plant) << plant.error().message;
  return std::move(*plant);
}

/// The value of an output.
inline double shown(const Plan& plan, const Plant& plant, std::string_view name) {
  for (std::size_t i = 0; i < plan.outputs.size(); ++i) {
    if (plan.outputs[i].name == name) return plant.outputs()[i];
  }
  ADD_FAILURE() << "no output " << name;
  return 0;
}

}  // namespace canhil::plant
