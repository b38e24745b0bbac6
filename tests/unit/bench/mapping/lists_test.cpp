// The lists in docs/mapping.md equal the lists in the code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "bench/mapping/mapping.hpp"
#include "bench/mapping/reference_quantities.hpp"
#include "bench/sensors/measurands.hpp"

namespace canhil::mapping {
namespace {

std::string page() {
  std::ostringstream text;
  text << std::ifstream(SOURCE_DIR "/docs/mapping.md").rdbuf();
  return text.str();
}

std::string unit(std::string_view si) { return si.empty() ? "" : fmt::format(" [{}]", si); }

std::string played() {
  std::map<std::string_view, std::string> by_node;
  std::string all = "| node | quantities |\n|---|---|\n";
  std::string_view before;
  for (const sensors::Measurand& one : sensors::measurands()) {
    const std::string_view key = one.sensor->key;
    all += key == before ? ", " : fmt::format("{}| `[{}]` | ", before.empty() ? "" : " |\n", key);
    all += fmt::format("`{}`{}", one.name, unit(one.si));
    before = key;
  }
  return all + " |\n";
}

std::string reported() {
  std::string all = "| quantity | what it is | unit |\n|---|---|---|\n";
  for (const ReferenceQuantity& one : reference_quantities()) {
    if (!one.of.empty()) continue;
    std::string meaning(one.quantity->meaning);
    meaning = meaning.substr(0, meaning.find(';'));  // the rest concerns campaigns
    if (meaning.starts_with("error of ")) meaning.erase(0, 9);
    all += fmt::format("| `{}` | {} | {} |\n", one.quantity->name, meaning, one.si);
  }
  return all;
}

std::string derived() {
  std::string all = "| quantity | what it is | derived from |\n|---|---|---|\n";
  for (const ReferenceQuantity& one : reference_quantities()) {
    if (one.of.empty()) continue;
    std::string parts;
    for (const quantities::Quantity* part : one.of)
      parts += fmt::format("{}`{}`", parts.empty() ? "" : ", ", part->name);
    const std::string_view meaning = one.quantity->meaning;
    all += fmt::format("| `{}` | {} | {}{} |\n", one.quantity->name, meaning.substr(0, meaning.find(';')),
                       parts, one.of_sigmas ? " and their sigmas" : "");
  }
  return all;
}

TEST(MappingPage, ListsWhatCanBePlayedAndReported) {
  EXPECT_NE(page().find("<!-- played -->\n" + played() + "<!-- /played -->"), std::string::npos) << played();
  EXPECT_NE(page().find("<!-- reported -->\n" + reported() + "<!-- /reported -->"), std::string::npos)
      << reported();
  EXPECT_NE(page().find("<!-- derived -->\n" + derived() + "<!-- /derived -->"), std::string::npos)
      << derived();
}

TEST(Lists, NameEachQuantityOnce) {
  std::set<std::string> names;
  for (const sensors::Measurand& one : sensors::measurands())
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
  for (const ReferenceQuantity& one : reference_quantities())
    EXPECT_EQ(find_reference_quantity(one.quantity->name), &one);
}

TEST(Layouts, OfTheSameColumnsAreTheSameObject) {
  const auto* layout = find_layout("attitude.roll velocity.north");
  ASSERT_NE(layout, nullptr);
  EXPECT_EQ(find_layout("attitude.roll velocity.north"), layout);
  EXPECT_NE(find_layout("velocity.north attitude.roll"), layout);
  EXPECT_EQ(quantities::names(*layout), "attitude.roll velocity.north");
  EXPECT_EQ(find_layout("attitude.roll nobody"), nullptr);
}

}  // namespace
}  // namespace canhil::mapping
