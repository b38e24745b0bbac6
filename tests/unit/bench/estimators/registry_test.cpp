#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "bench/drive/contract.hpp"
#include "bench/estimators/registry.hpp"
#include "target/device/device.hpp"

namespace canhil::estimators {
namespace {

using quantities::Quantity;

TEST(Registry, EveryQuantityHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const Quantity* quantity : every_quantity())
    EXPECT_TRUE(names.insert(quantity->name).second) << quantity->name;
}

TEST(Registry, KnowsTheEstimatorsOfTheContract) {
  std::vector<std::string> names;
  for (const Estimator* one : all()) {
    names.emplace_back(one->name);
    EXPECT_EQ(find(one->name), one);
    EXPECT_EQ(telling(quantities::names(one->layout)), one);
  }
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(drive::contract().estimators));
  EXPECT_EQ(find("wheel_odometry"), nullptr);
  EXPECT_EQ(telling("height"), nullptr);
}

// For a misspelt parameter, the bench suggests names from its own list. This list contains exactly the
// parameters of hil-target.
TEST(Registry, TheParametersAreThoseOfTheTarget) {
  const target::Device device;
  for (const auto estimator : messages::enumerators<messages::Estimator>) {
    const Estimator* known = find(name_of(estimator));
    std::vector<std::string_view> own;
    for (const auto parameter : messages::enumerators<messages::Parameter>) {
      if (device.range(estimator, parameter)) own.push_back(name_of(parameter));
    }
    if (known == nullptr) {
      EXPECT_TRUE(own.empty()) << name_of(estimator);
    } else {
      EXPECT_THAT(known->facts.parameters, testing::ElementsAreArray(own)) << known->name;
    }
  }
}

// The table of docs/quantities.md, generated from the code.
std::string table() {
  std::string rows;
  std::vector<const Quantity*> by_name(every_quantity().begin(), every_quantity().end());
  std::ranges::sort(by_name, {}, &Quantity::name);
  for (const Quantity* quantity : by_name) {
    std::vector<std::string_view> tellers;
    bool in_runs = false, sampled = false;
    for (const Estimator* one : all()) {
      const bool of_runs = std::ranges::find(one->of_runs, quantity) != one->of_runs.end();
      in_runs = in_runs || of_runs;
      sampled = sampled || quantities::has(one->layout, *quantity);
      if (of_runs || quantities::has(one->layout, *quantity)) tellers.push_back(one->name);
    }
    std::ranges::sort(tellers);
    rows += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", quantity->name, quantity->meaning,
                        quantity->unit.name,
                        quantity->degrees_of_freedom == 0 ? "" : std::to_string(quantity->degrees_of_freedom),
                        fmt::join(tellers, ", "), in_runs ? "yes" : "no", sampled ? "yes" : "no");
  }
  return rows;
}

TEST(Registry, TheDocumentedListIsThatOfTheCode) {
  std::ostringstream page;
  page << std::ifstream(SOURCE_DIR "/docs/quantities.md").rdbuf();
  EXPECT_NE(page.str().find("|---|---|---|---|---|---|---|\n" + table() + "\n"), std::string::npos)
      << "expected this table:\n"
      << table();
}

}  // namespace
}  // namespace canhil::estimators
